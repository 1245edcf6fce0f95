#include <folk/analysis/crew/failure.h>
#include <folk/analysis/crew/hand_out.h>
#include <folk/analysis/crew/hands.h>
#include <folk/analysis/crew/patience.h>
#include <folk/games/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace folk {
namespace {

/// Results are told in messages of about so many bytes.
constexpr std::size_t told_at_once = std::size_t{16} << 20U;

class HandOut {
public:
  HandOut(Correspondence& letters, const SharedWork& work, PieceStore* store, const Progress& progress)
      : letters_(letters),
        work_(work),
        store_(store),
        progress_(progress),
        identity_(work.identity()),
        done_(work.pieces, false),
        failed_at_(work.pieces) {}

  void run() {
    if (store_ != nullptr) take_what_is_kept();
    Hands hands(work_, store_ != nullptr);
    const std::size_t at_once = std::max(1U, work_.threads);
    Patience patience;
    std::size_t own = 0;
    while (!over()) {
      progress_.check();
      for (; own < at_once; ++own) {
        const auto piece = next_piece();
        if (!piece) break;
        hands.give(*piece);
      }
      while (const auto letter = letters_.receive()) {
        hear(*letter);
        patience.renew();
      }
      while (const auto finished = hands.take()) {
        --own;
        finish(finished->piece, finished->bytes, finished->failure);
        patience.renew();
      }
      if (!over() && (own == at_once || next_ >= failed_at_)) hands.wait(patience.next());
    }
    if (failure_) std::rethrow_exception(failure_);
  }

  void tell_all() {
    std::string bytes = *message({Word::all, letters_.run(), 0});
    const std::size_t empty = bytes.size();
    for (std::size_t piece = 0; piece < work_.pieces; ++piece) {
      const std::string result = work_.pack(piece);
      pack(bytes, std::uint64_t{piece});
      pack(bytes, std::uint64_t{result.size()});
      bytes += result;
      if (bytes.size() < told_at_once) continue;
      const std::string head = bytes.substr(0, empty);
      letters_.pass_on(std::move(bytes));
      bytes = head;
    }
    if (bytes.size() > empty) letters_.pass_on(std::move(bytes));
    letters_.pass_on(*message({Word::end, letters_.run(), 0}));
  }

private:
  void take_what_is_kept() {
    store_->begin(identity_, work_.pieces);
    for (std::size_t piece = 0; piece < work_.pieces; ++piece)
      if (const auto bytes = store_->find(piece)) {
        work_.unpack(piece, *bytes);
        count(piece);
      }
  }

  /// All pieces before the earliest that has thrown are done.
  bool over() {
    while (all_done_before_ < failed_at_ && done_[all_done_before_]) ++all_done_before_;
    return all_done_before_ == failed_at_;
  }

  std::optional<std::size_t> next_piece() {
    while (next_ < failed_at_ && done_[next_]) ++next_;
    if (next_ >= failed_at_) return std::nullopt;
    return next_++;
  }

  void offer(std::size_t rank, std::uint64_t pieces) {
    for (; pieces > 0; --pieces) {
      const auto piece = next_piece();
      if (!piece) return;
      letters_.send(rank, Word::piece, *piece);
    }
  }

  void hear(const Correspondence::Letter& letter) {
    const auto& head = letter.head;
    switch (head.word) {
      case Word::ready: {
        Unpacker content(letter.content());
        if (content.number<std::uint64_t>() != identity_)
          throw EnvironmentError(fmt::format(
              "rank {} has other work than rank 0: give all the same command and the same files", letter.from));
        offer(letter.from, head.number);
        break;
      }
      case Word::result:
        work_.unpack(head.number, letter.content());
        finish(head.number, letter.content(), nullptr);
        offer(letter.from, 1);
        break;
      case Word::failed:
        if (head.number == no_piece) std::rethrow_exception(failure_from(letter.content()));
        finish(head.number, {}, failure_from(letter.content()));
        break;
      case Word::piece:
      case Word::all:
      case Word::end:
      case Word::stop:
      case Word::leave: break;  // what only rank 0 says
    }
  }

  void finish(std::size_t piece, std::string_view bytes, const std::exception_ptr& failure) {
    if (failure) {
      if (piece >= failed_at_) return;
      failed_at_ = piece;
      failure_ = failure;
      return;
    }
    if (store_ != nullptr) store_->keep(piece, bytes);
    count(piece);
  }

  void count(std::size_t piece) {
    done_[piece] = true;
    if (++finished_ <= work_.pieces && !failure_)
      progress_(static_cast<double>(finished_) / static_cast<double>(work_.pieces));
  }

  Correspondence& letters_;
  const SharedWork& work_;
  PieceStore* store_;
  const Progress& progress_;
  std::uint64_t identity_;
  std::vector<bool> done_;
  std::size_t all_done_before_ = 0;
  std::size_t finished_ = 0;
  std::size_t next_ = 0;
  std::size_t failed_at_;  // the earliest piece that has thrown
  std::exception_ptr failure_;
};

}  // namespace

void hand_out(Correspondence& letters, const SharedWork& work, PieceStore* store, const Progress& progress) {
  HandOut rank_0(letters, work, store, progress);
  try {
    rank_0.run();
  } catch (...) {
    letters.send_all(Word::stop, failure_bytes(std::current_exception()));
    throw;
  }
  rank_0.tell_all();
}

}  // namespace folk
