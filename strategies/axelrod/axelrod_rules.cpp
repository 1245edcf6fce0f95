#include <folk/strategies/axelrod/axelrod_rules.h>
#include <folk/strategies/axelrod/balance_machine.h>
#include <folk/strategies/axelrod/classifiers.h>
#include <folk/strategies/axelrod/counting_machine.h>
#include <folk/strategies/axelrod/counting_rules.h>
#include <folk/strategies/axelrod/derived_belief.h>
#include <folk/strategies/axelrod/evolved_network.h>
#include <folk/strategies/axelrod/first_tournament.h>
#include <folk/strategies/axelrod/grumpy_machine.h>
#include <folk/strategies/axelrod/hunters.h>
#include <folk/strategies/axelrod/learners.h>
#include <folk/strategies/axelrod/punishers.h>
#include <folk/strategies/axelrod/rule.h>
#include <folk/strategies/axelrod/second_tournament.h>
#include <folk/strategies/axelrod/second_tournament_mixed.h>
#include <folk/strategies/axelrod/sequences.h>
#include <folk/strategies/axelrod/windows.h>

#include <numbers>
#include <utility>
#include <vector>

namespace folk {
namespace {

constexpr const char* first =
    "Axelrod, Journal of Conflict Resolution 24(1), 1980; gaps filled as in Axelrod-Python 4.13.0";
constexpr const char* second =
    "Axelrod, Journal of Conflict Resolution 24(3), 1980; its Fortran as read in Axelrod-Python 4.13.0";
constexpr const char* owen_campbell = "Owen Campbell, in Axelrod-Python 4.13.0";
constexpr const char* thomas_campbell = "Thomas Campbell, in Axelrod-Python 4.13.0";
constexpr const char* harper = "Marc Harper, in Axelrod-Python 4.13.0";
constexpr const char* langner = "Karol Langner, in Axelrod-Python 4.13.0";
constexpr const char* palmer = "Geraint Palmer, in Axelrod-Python 4.13.0";
constexpr const char* standen = "Timothy Standen, in Axelrod-Python 4.13.0";
constexpr const char* young = "Jason Young, in Axelrod-Python 4.13.0";
constexpr const char* prison = "PRISON, University of Lille, 1998";
constexpr const char* li = "Li, Hingston & Kendall, IEEE Trans. CIAIG 3(4), 2011";
constexpr const char* coopsim = "Arnold, CoopSim 0.9.9, 2016";
constexpr const char* bricks = "Andre, Honovan, Felipe & Frederico, BRICS-CCI 2013";
constexpr const char* trained = "Harper et al., PLoS ONE 12(12), 2017";

struct Entry {
  Description description;
  Strategy (*make)(std::string name);
};

template <const BalanceMachine::Rule& rule>
Strategy balance(std::string name) {
  return {std::move(name), std::make_shared<BalanceMachine>(rule), nullptr};
}

template <class M>
Strategy machine(std::string name) {
  return {std::move(name), std::make_shared<M>(), nullptr};
}

template <CountingRule R>
Strategy counting(std::string name) {
  return machine<CountingMachine<R>>(std::move(name));
}

template <Rule R>
Strategy finite(std::string name) {
  return machine_by_rule<R>(std::move(name));
}

template <Rule R>
Strategy played(std::string name) {
  return played_by_rule<R>(std::move(name));
}

template <Rule R>
Strategy drawn(std::string name) {
  return played_by_rule<R>(std::move(name), false);
}

using enum BalanceMachine::Answer;
constexpr BalanceMachine::Rule doubler{{1, -2, 1, -2}, copy, copy, cooperate};
constexpr BalanceMachine::Rule forgiver{{-1, 9, -1, 9}, cooperate, cooperate, defect};
constexpr BalanceMachine::Rule forgiving_tit_for_tat{{-1, 9, -1, 9}, cooperate, cooperate, copy};
constexpr BalanceMachine::Rule level_punisher{{-1, 4, -1, 4}, cooperate, cooperate, defect, 10};
constexpr BalanceMachine::Rule retaliate{{0, 10, -1, 0}, cooperate, cooperate, defect};
constexpr BalanceMachine::Rule retaliate_2{{0, 25, -2, 0}, cooperate, cooperate, defect};
constexpr BalanceMachine::Rule retaliate_3{{0, 20, -1, 0}, cooperate, cooperate, defect};
constexpr BalanceMachine::Rule very_bad{{1, -1, 1, -1}, defect, copy, cooperate, 3};

constexpr double golden_ratio() { return std::numbers::phi; }
constexpr double circle_ratio() { return std::numbers::pi; }
constexpr double euler_number() { return std::numbers::e; }

// clang-format off
const std::vector<Entry>& entries() {
  static const std::vector<Entry> all{
      // large finite memories
      {{"adaptive_pavlov_2006", {"APavlov2006"}, "tit_for_tat for 6 rounds; then every 6 rounds sorts the opponent by the word of its last 6 moves", "Li, in Kendall, Yao & Chong, The Iterated Prisoners' Dilemma, 2007"}, finite<AdaptivePavlov2006>},
      {{"adaptive_pavlov_2011", {"APavlov2011"}, "tit_for_tat for 6 rounds; then every 6 rounds sorts the opponent by the number of D in them", li}, finite<AdaptivePavlov2011>},
      {{"go_by_majority_5", {}, "the majority of their last 5 moves, C at a tie", langner}, finite<WindowMajority<5, Move::C>>},
      {{"go_by_majority_10", {}, "the majority of their last 10 moves, C at a tie", langner}, finite<WindowMajority<10, Move::C>>},
      {{"go_by_majority_20", {}, "the majority of their last 20 moves, C at a tie", langner}, finite<WindowMajority<20, Move::C>>},
      {{"go_by_majority_40", {}, "the majority of their last 40 moves, C at a tie", langner}, finite<WindowMajority<40, Move::C>>},
      {{"hard_go_by_majority_5", {}, "the majority of their last 5 moves, D at a tie", langner}, finite<WindowMajority<5, Move::D>>},
      {{"hard_go_by_majority_10", {}, "the majority of their last 10 moves, D at a tie", langner}, finite<WindowMajority<10, Move::D>>},
      {{"hard_go_by_majority_20", {}, "the majority of their last 20 moves, D at a tie", langner}, finite<WindowMajority<20, Move::D>>},
      {{"hard_go_by_majority_40", {}, "the majority of their last 40 moves, D at a tie", langner}, finite<WindowMajority<40, Move::D>>},
      {{"short_mem", {}, "C 11 times; then what leads by 3 or more among their last 10 moves, else their last", bricks}, finite<ShortMemory>},
      {{"prober_4", {}, "20 fixed moves; then all_d if they answered its D and its C about alike, else C 5 times and tit_for_tat", prison}, finite<Prober4>},
      {{"double_crosser", {}, "as back_stabber; tf2t from round 8 to 180 if they played C in the first 7", thomas_campbell, "Axelrod-Python's also plays D in the last two rounds of a match whose length it knows"}, finite<DoubleCrosser>},
      {{"tricky_level_punisher", {}, "for 100 rounds D while over 1/20 of their moves were D; then C", coopsim}, finite<TrickyLevelPunisher>},
      {{"defector_hunter", {}, "C; from round 5 on D against who has played only D", langner}, finite<ConstantHunter<Move::D>>},
      {{"cooperator_hunter", {}, "C; from round 5 on D against who has played only C", langner}, finite<ConstantHunter<Move::C>>},
      {{"alternator_hunter", {}, "C; from round 7 on D against who alternated until then", langner}, finite<AlternatorHunter>},
      {{"second_by_grofman", {}, "C, C; tit_for_tat to round 7; then C unless they played D often in the 7 rounds before the last", second}, finite<SecondGrofman>},
      {{"first_by_feld", {"feld"}, "tit_for_tat that plays D after C with a probability that grows from 0 to 1/2 in 200 rounds", first}, finite<Feld>},
      {{"first_by_tullock", {"tullock"}, "C 11 times; then C with a probability 1/10 below the share of C in their last 10 moves", first}, finite<Tullock>},
      // counters
      {{"doubler", {}, "D after their D unless their C are more than twice their D", prison}, balance<doubler>},
      {{"forgiver", {}, "D while more than 1/10 of their moves were D", thomas_campbell}, balance<forgiver>},
      {{"forgiving_tit_for_tat", {}, "tit_for_tat while more than 1/10 of their moves were D, else C", thomas_campbell}, balance<forgiving_tit_for_tat>},
      {{"level_punisher", {}, "C 10 times; then D while more than 1/5 of their moves were D", coopsim}, balance<level_punisher>},
      {{"retaliate", {}, "D while it was the sucker more often than 1/10 of the times it was tempted", owen_campbell}, balance<retaliate>},
      {{"retaliate_2", {}, "D while it was the sucker more often than 2/25 of the times it was tempted", owen_campbell}, balance<retaliate_2>},
      {{"retaliate_3", {}, "D while it was the sucker more often than 1/20 of the times it was tempted", owen_campbell}, balance<retaliate_3>},
      {{"very_bad", {}, "C 3 times; then what they have played more often, at a tie their last move", bricks}, balance<very_bad>},
      {{"limited_retaliate", {}, "as retaliate, but at most 20 D in a row", owen_campbell}, counting<LimitedRetaliate<10, 1, 20>>},
      {{"limited_retaliate_2", {}, "as retaliate_2, but at most 15 D in a row", owen_campbell}, counting<LimitedRetaliate<25, 2, 15>>},
      {{"limited_retaliate_3", {}, "as retaliate_3, but at most 20 D in a row", owen_campbell}, counting<LimitedRetaliate<20, 1, 20>>},
      {{"omega_tft", {"omega_tit_for_tat"}, "tit_for_tat that breaks deadlocks by two C and plays D against who seems random", "Slany & Kienreich, in Kendall, Yao & Chong, 2007"}, counting<OmegaTitForTat>},
      {{"second_by_gladstein", {"gladstein"}, "D, then C and D by halves until their first D; one C, then tit_for_tat", second}, counting<Gladstein>},
      {{"second_by_mikkelson", {"mikkelson"}, "gives credit for C and takes it for D; D when none is left and they defect often", second}, counting<Mikkelson>},
      {{"grumpy", {}, "C until their D lead by more than 10, then D until their C lead by more than 10, and so on", young}, machine<GrumpyMachine>},
      // played
      {{"punisher", {}, "answers a D by a D and as many more as the 20ths of rounds in which they played D", palmer}, played<ProportionalPunisher<Move::D>>},
      {{"inverse_punisher", {}, "answers a D by a D and as many more as the 20ths of rounds in which they played C, at least one", palmer}, played<ProportionalPunisher<Move::C>>},
      {{"anti_cycler", {}, "C, D; then D after no C, one C, two C, and so on", harper}, played<AntiCycler>},
      {{"thue_morse", {}, "the Thue-Morse sequence, D for 0", palmer}, played<ThueMorse<Move::D>>},
      {{"thue_morse_inverse", {}, "the Thue-Morse sequence, C for 0", palmer}, played<ThueMorse<Move::C>>},
      {{"golden", {}, "C; D while they have played no D or both sides' C are over the golden ratio times the D", standen}, played<CooperationRatio<golden_ratio>>},
      {{"pi", {}, "as golden, with the number pi", standen}, played<CooperationRatio<circle_ratio>>},
      {{"e", {}, "as golden, with Euler's number", standen}, played<CooperationRatio<euler_number>>},
      {{"cycle_hunter", {}, "C; D for ever once they have played a cycle of 3 to 12 moves", harper}, played<CycleHunter>},
      {{"eventual_cycle_hunter", {}, "every 10 rounds decides whether they cycle from round 11 on: then D, else C", harper}, played<EventualCycleHunter>},
      {{"math_constant_hunter", {}, "D while C are about as frequent in both halves and in the middle of the match", langner}, played<MathConstantHunter>},
      {{"random_hunter", {}, "D while they answer its C by C, and its D by D, in about half of the cases", langner}, played<RandomHunter>},
      {{"meta_hunter", {}, "D when one of a team of six hunters would; C, after 100 rounds tit_for_tat, when none would", langner}, played<MetaHunter<false>>},
      {{"meta_hunter_aggressive", {}, "as meta_hunter, with the hunter of cooperators in the team", harper}, played<MetaHunter<true>>},
      {{"adaptive", {}, "C 6 times, D 5 times; then the move that has earned more so far", li}, played<Adaptive>},
      {{"adaptive_tit_for_tat", {}, "C while the world, which moves half way to each move of theirs, is at least half good", "Tzafestas, SAB 2000"}, played<AdaptiveTitForTat>},
      {{"dbs", {"derived_belief_strategy"}, "learns rules of the opponent's play, tells slips from changes, and plans 5 rounds ahead", "Au & Nau, AAMAS 2006"}, played<DerivedBelief>},
      {{"evolved_ann", {}, "a trained network of 10 units over 17 facts of the match", trained}, played<EvolvedNetwork<evolved_ann_weights>>},
      {{"evolved_ann_5", {}, "a trained network of 5 units over 17 facts of the match", trained}, played<EvolvedNetwork<evolved_ann_5_weights>>},
      {{"evolved_ann_noise_05", {}, "a network of 5 units trained with 5 % of moves slipping", trained}, played<EvolvedNetwork<evolved_ann_noise_05_weights>>},
      // the first tournament
      {{"first_by_downing", {"downing"}, "D, D; then the better reply to how often they play C after its C and after its D", first}, played<Downing>},
      {{"first_by_shubik", {"shubik"}, "each D against its C is answered by one D more than the last", first}, played<Shubik>},
      {{"first_by_stein_and_rapoport", {"stein_and_rapoport"}, "C 4 times, then tit_for_tat; every 15 rounds decides whether they are random: then D", first, "the entrant also plays D in the last two rounds, whose number a Folk strategy is not told"}, played<SteinRapoport>},
      {{"first_by_tideman_and_chieruzzi", {}, "retaliates with one D more each time; a fresh start for who is 10 points behind and not random", first, "the entrant also plays D in the last two rounds, whose number a Folk strategy is not told"}, played<TidemanChieruzzi>},
      {{"first_by_graaskamp", {"graaskamp"}, "tit_for_tat with a D in round 51; from 57 on by kind: D against random, tit_for_tat, or C with a D now and then", first, "Axelrod-Python's program waits 5 to 14 rounds between two such D, the article's entrant 5 to 15"}, drawn<Graaskamp>},
      // the second tournament
      {{"revised_downing", {}, "C; then the better reply, or alternation, to how often they play C after its C and after its D", second}, played<RevisedDowning>},
      {{"second_by_borufsen", {"borufsen"}, "tit_for_tat that ends mutual D and echoes; every 25 rounds turns to or from D by their C", second}, played<Borufsen>},
      {{"second_by_graaskamp_katzen", {}, "tit_for_tat; D for ever once its score falls behind at one of six milestones", second}, played<GraaskampKatzen>},
      {{"second_by_richard_hufford", {"richard_hufford"}, "C, tit_for_tat or D by how often they did what it had done; tests long cooperation", second}, played<Hufford>},
      {{"second_by_rowsam", {"rowsam"}, "C, but D, C, D when it earns little; D for ever when it has been little too often", second}, played<Rowsam>},
      {{"second_by_tideman_and_chieruzzi", {}, "D while its lead is below a bound that each new D raises; now and then a fresh start", second}, played<SecondTidemanChieruzzi>},
      {{"second_by_weiner", {"weiner"}, "tit_for_tat that forgives now and then, but D while 5 of 12 moves were D", second}, played<Weiner>},
      {{"second_by_white", {"white"}, "C 10 times; then D after a D if their D times floor(log round) reach the round", second}, played<White>},
      {{"second_by_yamachi", {"yamachi"}, "what they played more often in the same situation; late, D against who defects half the time", second}, played<Yamachi>},
      {{"second_by_leyvraz", {"leyvraz"}, "C with a probability by their last three moves: 1, 1/2, 0, 1/4, 1, 1, 1, 1/4 from C, C, C to D, D, D", second}, finite<Leyvraz>},
      {{"second_by_black", {"black"}, "C 5 times; then the less often, the more D were in their last 5 moves", second}, finite<Black>},
      {{"second_by_champion", {"champion"}, "C 10 times, tit_for_tat to round 25; then D after D as often as they defect, if that is often", second}, drawn<SecondChampion>},
      {{"second_by_eatherley", {"eatherley"}, "D after D as often as they defect", second}, drawn<Eatherley>},
      {{"second_by_getzler", {"getzler"}, "D with a probability to which each D of theirs adds a half, a quarter and so on", second}, drawn<Getzler>},
      {{"second_by_cave", {"cave"}, "D against who defects often; else D after every second D", second}, drawn<Cave>},
      {{"second_by_wm_adams", {"william_adams"}, "D at their 4th, 7th and 9th D; later C after D with halving probability", second}, drawn<WilliamAdams>},
      {{"second_by_kluepfel", {"kluepfel"}, "by the run in their last three moves; late, D against who answers C and D alike", second}, drawn<Kluepfel>},
      {{"second_by_appold", {"appold"}, "C 4 times; then C as often as they answered its move before the last by C", second}, drawn<Appold>},
      // PRISON's
      {{"calculator", {}, "joss for 20 rounds; then D if they have played a cycle, else tit_for_tat", prison}, drawn<Calculator>},
  };
  return all;
}
// clang-format on

}  // namespace

void add_axelrod_rules(Registry& registry) {
  for (const Entry& entry : entries())
    registry.add(entry.description,
                 [make = entry.make](const std::string& name, std::string_view, const Payoffs&) { return make(name); });
}

}  // namespace folk
