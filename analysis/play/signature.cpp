#include <folk/analysis/play/signature.h>
#include <folk/strategies/automaton.h>

// The functions themselves, in this file alone: programs need no library of xxHash to run.
#define XXH_INLINE_ALL
#include <xxhash.h>

namespace folk {

struct Signature::State {
  XXH3_state_t xxh3;
};

Signature::Signature()
    : state_(std::make_unique<State>()) {
  XXH3_64bits_reset(&state_->xxh3);
}

Signature::~Signature() = default;

void Signature::add(std::string_view text) {
  add(std::uint64_t{text.size()});
  hand_over();
  XXH3_64bits_update(&state_->xxh3, text.data(), text.size());
}

void Signature::add(const Automaton& automaton) {
  add(std::uint64_t{automaton.size()});
  add(std::uint64_t{automaton.start()});
  add(std::uint64_t{automaton.beyond() ? *automaton.beyond() : automaton.size()});
  for (const auto& node : automaton.nodes()) {
    add(node.cooperation);
    for (const std::uint32_t next : node.next) add(std::uint64_t{next});
  }
}

void Signature::hand_over() {
  XXH3_64bits_update(&state_->xxh3, block_.data(), waiting_);
  waiting_ = 0;
}

std::uint64_t Signature::value() const {
  State all = *state_;
  XXH3_64bits_update(&all.xxh3, block_.data(), waiting_);
  return XXH3_64bits_digest(&all.xxh3);
}

}  // namespace folk
