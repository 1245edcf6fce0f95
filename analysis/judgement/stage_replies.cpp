#include <folk/analysis/judgement/stage_replies.h>

#include <algorithm>
#include <array>
#include <map>

namespace folk {

StageReplies stage_replies(const std::vector<RecordedMatch>& matches, const Payoffs& payoffs) {
  const auto by_outcome = payoffs.by_outcome();
  std::map<double, std::array<double, 2>> losses;  // by belief, of C and of D
  const auto losses_at = [&](double belief) {
    const auto [place, fresh] = losses.try_emplace(belief);
    if (fresh) {
      const Rational p = as_written(belief);
      const auto expected = [&](Move own) {
        return p * by_outcome[Outcome{own, Move::C}.index()] + (1 - p) * by_outcome[Outcome{own, Move::D}.index()];
      };
      const Rational lead = expected(Move::C) - expected(Move::D);
      place->second = {to_double(std::max<Rational>(-lead, 0)), to_double(std::max<Rational>(lead, 0))};
    }
    return place->second;
  };
  StageReplies replies;
  for (const auto& match : matches) {
    for (const BeliefRound& round : match.rounds) {
      if (!round.belief) continue;
      const double loss = losses_at(*round.belief)[bit(round.own)];
      ++replies.rounds;
      if (loss == 0) ++replies.best;
      replies.loss_sum += loss;
      replies.largest_loss = std::max(replies.largest_loss, loss);
    }
  }
  return replies;
}

}  // namespace folk
