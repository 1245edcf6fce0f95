#include <folk/analysis/crew/correspondence.h>
#include <folk/analysis/crew/hand_out.h>
#include <folk/analysis/crew/help.h>
#include <folk/analysis/crew/patience.h>
#include <folk/analysis/crew/ranks.h>
#include <folk/games/error.h>

#include <fmt/format.h>

#include <thread>
#include <utility>

namespace folk {
namespace {

/// The store of a work of one piece that is done.
class KnownPiece : public PieceStore {
public:
  explicit KnownPiece(std::string bytes)
      : bytes_(std::move(bytes)) {}

  void begin(std::uint64_t, std::size_t) override {}
  std::optional<std::string> find(std::size_t) override { return bytes_; }
  void keep(std::size_t, std::string_view) override {}

private:
  std::string bytes_;
};

}  // namespace

struct Ranks::State {
  Correspondence letters;
  bool dismissed = false;
};

Ranks::Ranks(std::unique_ptr<Transport> transport)
    : state_(std::make_unique<State>(State{Correspondence(std::move(transport))})) {}

Ranks::~Ranks() = default;

std::size_t Ranks::ranks() const { return state_->letters.ranks(); }

std::size_t Ranks::rank() const { return state_->letters.rank(); }

void Ranks::agree(std::uint64_t command, const Progress& progress) const {
  Correspondence& letters = state_->letters;
  if (!first()) {
    letters.send(0, Word::ready, command);
    return;
  }
  Patience patience;
  for (std::size_t waited_for = ranks() - 1; waited_for > 0;) {
    progress.check();
    const auto letter = letters.receive();
    if (!letter) {
      std::this_thread::sleep_for(patience.next());
      continue;
    }
    if (letter->head.word != Word::ready || letter->head.run != 0) continue;
    if (letter->head.number != command)
      throw UsageError(
          fmt::format("rank {} was given another command than rank 0: ranks share the work of one", letter->from));
    --waited_for;
  }
}

void Ranks::run(const SharedWork& work, const Progress& progress) const {
  state_->letters.begin_run();
  if (first()) {
    hand_out(state_->letters, work, store(), progress);
  } else {
    help_until_dismissed(work, progress);
  }
}

std::string Ranks::tell(std::string bytes) const {
  state_->letters.begin_run();
  const SharedWork work{[] { return std::uint64_t{0}; },
                        1,
                        1,
                        [](std::size_t, unsigned) {},
                        [&](std::size_t) { return bytes; },
                        [&](std::size_t, std::string_view told) { bytes = std::string(told); }};
  if (first()) {
    KnownPiece known(bytes);
    hand_out(state_->letters, work, &known, nullptr);
  } else {
    help_until_dismissed(work, nullptr);
  }
  return bytes;
}

void Ranks::help_until_dismissed(const SharedWork& work, const Progress& progress) const {
  try {
    help(state_->letters, work, progress);
  } catch (const Dismissed&) {
    state_->dismissed = true;
    throw;
  }
}

void Ranks::leave(const std::exception_ptr& failure) {
  Correspondence& letters = state_->letters;
  if (first()) {
    letters.pass_on(*message({Word::leave, letters.run(), 0}));
  } else if (!state_->dismissed) {
    if (failure) letters.send(0, Word::failed, no_piece, failure_bytes(failure, fmt::format("rank {}: ", rank())));
    Patience patience;
    for (;;) {
      const auto letter = letters.receive();
      if (letter && letter->head.word == Word::leave) {
        letters.pass_on(letter->bytes);
        break;
      }
      if (!letter) std::this_thread::sleep_for(patience.next());
    }
  }
  letters.close();
}

}  // namespace folk
