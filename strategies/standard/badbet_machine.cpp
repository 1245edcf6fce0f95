#include <folk/games/outcome.h>
#include <folk/strategies/standard/badbet_machine.h>

#include <algorithm>
#include <array>

namespace folk {
namespace {

enum Bet : unsigned { tit_for_tat = 0, all_c = 1, spiteful = 2, per_ccd = 3 };

constexpr unsigned rounds_a_bet = 4;

/// What badbet keeps of a match.
struct Book {
  unsigned bet = tit_for_tat;
  unsigned round = 0;                // of the present bet
  bool first_time = true;            // still trying each in turn
  bool provoked = false;             // tit_for_tat's memory: their last move was D
  bool spited = false;               // spiteful's memory
  unsigned place = 0;                // per_ccd's place in its word
  std::array<unsigned, 4> scores{};  // at most 20 each

  State pack() const {
    State state = bet | (round << 2U) | (unsigned{first_time} << 4U) | (unsigned{provoked} << 5U) |
                  (unsigned{spited} << 6U) | (place << 7U);
    for (unsigned i = 0; i < 4; ++i) state |= State{scores[i]} << (9 + 5 * i);
    return state;
  }
  static Book unpack(State state) {
    const auto bits = [&](unsigned shift, unsigned mask) { return static_cast<unsigned>(state >> shift) & mask; };
    Book book{bits(0, 3), bits(2, 3), bits(4, 1) != 0, bits(5, 1) != 0, bits(6, 1) != 0, bits(7, 3), {}};
    for (unsigned i = 0; i < 4; ++i) book.scores[i] = bits(9 + 5 * i, 31);
    return book;
  }

  void next_bet() {
    round = 0;
    if (first_time && bet != per_ccd) {
      ++bet;
      return;
    }
    first_time = false;
    bet = static_cast<unsigned>(std::max_element(scores.begin(), scores.end()) - scores.begin());
    scores[bet] = 0;
  }
};

}  // namespace

State BadbetMachine::start() const { return Book{}.pack(); }

double BadbetMachine::cooperation(State state) const {
  const Book book = Book::unpack(state);
  switch (book.bet) {
    case tit_for_tat: return book.provoked ? 0 : 1;
    case spiteful: return book.spited ? 0 : 1;
    case per_ccd: return book.place == 2 ? 0 : 1;
    default: return 1;
  }
}

State BadbetMachine::next(State state, Move own, Move theirs) const {
  constexpr std::array<unsigned, 4> points{3, 0, 5, 1};
  Book book = Book::unpack(state);
  book.scores[book.bet] += points[Outcome{own, theirs}.index()];
  switch (book.bet) {
    case tit_for_tat: book.provoked = theirs == Move::D; break;
    case spiteful:
      book.spited = (book.spited && spite_ == Spite::for_ever) || own == Move::D || theirs == Move::D;
      break;
    case per_ccd: book.place = (book.place + 1) % 3; break;
    default: break;
  }
  if (++book.round == rounds_a_bet) book.next_bet();
  return book.pack();
}

}  // namespace folk
