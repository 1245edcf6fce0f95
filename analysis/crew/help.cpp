#include <folk/analysis/crew/failure.h>
#include <folk/analysis/crew/hands.h>
#include <folk/analysis/crew/help.h>
#include <folk/analysis/crew/patience.h>

#include <algorithm>
#include <vector>

namespace folk {
namespace {

/// One piece waits beside those that are worked at, so that no thread waits for an answer of rank 0.
constexpr std::uint64_t ahead = 1;

class Help {
public:
  Help(Correspondence& letters, const SharedWork& work)
      : letters_(letters),
        work_(work),
        own_(work.pieces, false),
        hands_(work, true) {
    std::string identity;
    pack(identity, work.identity());
    letters_.send(0, Word::ready, std::max(1U, work.threads) + ahead, identity);
  }

  void run(const Progress& progress) {
    Patience patience;
    bool told_to_end = false;
    while (!ended_) {
      if (!told_to_end && progress.cancelled()) {
        told_to_end = true;
        letters_.send(0, Word::failed, no_piece, failure_bytes(std::make_exception_ptr(Cancelled())));
      }
      while (!ended_) {
        const auto letter = letters_.receive();
        if (!letter) break;
        hear(*letter);
        patience.renew();
      }
      while (const auto finished = hands_.take()) {
        if (finished->failure) {
          letters_.send(0, Word::failed, finished->piece, failure_bytes(finished->failure));
        } else {
          own_[finished->piece] = true;
          letters_.send(0, Word::result, finished->piece, finished->bytes);
        }
        patience.renew();
      }
      if (!ended_) hands_.wait(patience.next());
    }
  }

private:
  void hear(const Correspondence::Letter& letter) {
    switch (letter.head.word) {
      case Word::piece: hands_.give(letter.head.number); break;
      case Word::all:
        place(letter.content());
        letters_.pass_on(letter.bytes);
        break;
      case Word::end:
        letters_.pass_on(letter.bytes);
        ended_ = true;
        break;
      case Word::stop: std::rethrow_exception(failure_from(letter.content()));
      case Word::leave: letters_.pass_on(letter.bytes); throw Dismissed();
      case Word::ready:
      case Word::result:
      case Word::failed: break;  // what only others say
    }
  }

  void place(std::string_view content) {
    Unpacker results(content);
    while (results.left() > 0) {
      const auto piece = results.number<std::uint64_t>();
      const auto bytes = results.bytes(results.number<std::uint64_t>());
      if (piece < own_.size() && !own_[piece]) work_.unpack(piece, bytes);
    }
  }

  Correspondence& letters_;
  const SharedWork& work_;
  std::vector<bool> own_;  // pieces that this rank has done
  bool ended_ = false;
  Hands hands_;
};

}  // namespace

void help(Correspondence& letters, const SharedWork& work, const Progress& progress) {
  Help(letters, work).run(progress);
}

}  // namespace folk
