#include <folk/games/random.h>

#include <Random123/philox.h>

namespace folk {

void RandomStream::refill() {
  using Generator = r123::Philox4x64;
  const Generator::ctr_type counter{{index_++, key_.pair, key_.repetition, key_.role}};
  const Generator::key_type key{{key_.seed, 0}};
  const Generator::ctr_type block = Generator{}(counter, key);
  for (std::size_t i = 0; i < block_.size(); ++i) block_[i] = block[i];
  used_ = 0;
}

}  // namespace folk
