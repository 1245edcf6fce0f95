#include <folk/analysis/play/group_play.h>
#include <folk/analysis/play/sampled_play.h>

namespace folk {

PairResult play_sampled(const Strategy& first, const Strategy& second, std::uint64_t pair, const Sampling& sampling) {
  return play_group({Contest{&first, &second, pair}}, sampling).front();
}

}  // namespace folk
