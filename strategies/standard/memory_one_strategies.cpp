#include <folk/strategies/standard/finite_strategies.h>

namespace folk {

// clang-format off
const std::vector<FiniteStrategy>& memory_one_strategies() {
  static const std::vector<FiniteStrategy> strategies{
      {"firm_but_fair", {}, "mem1(c;1,0,1,2/3)", "C; then C but after own C and their D, and after both D with probability 2/3", "Frean, Proceedings of the Royal Society B 257, 1994"},
      {"stochastic_cooperator", {}, "mem1(c;187/200,229/1000,133/500,21/50)", "C; then by the last round", "Adami & Hintze, Nature Communications 4, 2013"},
      {"stochastic_wsls", {"stochastic_pavlov"}, "mem1(c;19/20,1/20,1/20,19/20)", "pavlov that plays the other move in one round of twenty, but for the first", "Marc Harper, in Axelrod-Python 4.13.0"},
      {"soft_joss", {}, "mem1(c;1,1/10,1,1/10)", "tit_for_tat that plays C after their D with probability 1/10", "PRISON, University of Lille, 1998"},
      {"generous_tit_for_tat", {"GTFT"}, "mem1(c;1,1/3,1,1/3)", "tit_for_tat that plays C after their D with probability 1/3", "Nowak & Sigmund, Nature 355, 1992"},
      {"zd_extortion", {}, "mem1(c;16/25,9/50,7/25,0)", "C; then own payoff - P = 10 (their payoff - P)", "Roemheld, arXiv 1308.2576, 2013"},
      {"zd_extort_2", {}, "mem1(c;8/9,1/2,1/3,0)", "C; then own payoff - P = 2 (their payoff - P)", "Stewart & Plotkin, PNAS 109, 2012"},
      {"zd_extort_2_v2", {"ZDExtort2v2"}, "mem1(c;7/8,7/16,3/8,0)", "C; then own payoff - P = 2 (their payoff - P), another scale", "Kuhn, Prisoner's Dilemma, Stanford Encyclopedia of Philosophy, 2017"},
      {"zd_extort_3", {}, "mem1(c;11/13,1/2,7/26,0)", "C; then own payoff - P = 3 (their payoff - P)", "Marc Harper, in Axelrod-Python 4.13.0"},
      {"zd_extort_4", {}, "mem1(c;11/17,0,8/17,0)", "C; then own payoff - P = 4 (their payoff - P)", "Marc Harper, in Axelrod-Python 4.13.0"},
      {"zd_gen_2", {}, "mem1(c;1,9/16,1/2,1/8)", "C; then own payoff - R = 2 (their payoff - R)", "Kuhn, Prisoner's Dilemma, Stanford Encyclopedia of Philosophy, 2017"},
      {"zd_gtft_2", {}, "mem1(c;1,1/8,1,1/4)", "C; then own payoff - R = 2 (their payoff - R)", "Stewart & Plotkin, PNAS 109, 2012"},
      {"zd_mischief", {}, "mem1(c;4/5,3/5,1/10,0)", "C; then their payoff is P", "Roemheld, arXiv 1308.2576, 2013"},
      {"zd_set_2", {}, "mem1(c;3/4,1/4,1/2,1/4)", "C; then their payoff is 2", "Kuhn, Prisoner's Dilemma, Stanford Encyclopedia of Philosophy, 2017"},
  };
  return strategies;
}
// clang-format on

}  // namespace folk
