#include <folk/strategies/standard/finite_strategies.h>

namespace folk {
namespace {

constexpr std::string_view campbell = "Thomas Campbell, in Axelrod-Python 4.13.0";
constexpr std::string_view harper = "Marc Harper, in Axelrod-Python 4.13.0";
constexpr std::string_view taylor_smith = "J. Taylor Smith, in Axelrod-Python 4.13.0";
constexpr std::string_view langner = "Karol Langner, in Axelrod-Python 4.13.0";
constexpr std::string_view marissa = "Holly Marissa, in Axelrod-Python 4.13.0";
constexpr std::string_view mueller = "Jochen Müller, in Axelrod-Python 4.13.0";
constexpr std::string_view palmer = "Geraint Palmer, in Axelrod-Python 4.13.0";
constexpr std::string_view first =
    "Axelrod, Journal of Conflict Resolution 24(1), 1980; gaps filled as in Axelrod-Python 4.13.0";
constexpr std::string_view second =
    "Axelrod, Journal of Conflict Resolution 24(3), 1980; its Fortran as read in Axelrod-Python 4.13.0";
constexpr std::string_view evolution = "Axelrod, The Evolution of Cooperation, 1984";
constexpr std::string_view berg = "Van den Berg & Weissing, Proceedings of the Royal Society B 282, 2015";
constexpr std::string_view lesswrong = "Zoo of Strategies, LessWrong, 2011";
constexpr std::string_view prison = "PRISON, University of Lille, 1998";
constexpr std::string_view coopsim = "Arnold, CoopSim 0.9.9, 2016";
constexpr std::string_view li = "Li, Hingston & Kendall, IEEE Trans. CIAIG 3(4), 2011";
constexpr std::string_view hilbe = "Hilbe, Martinez-Vaquero, Chatterjee & Nowak, PNAS 114, 2017";
constexpr std::string_view ashlock = "Ashlock & Ashlock, IEEE Congress on Evolutionary Computation, 2006";
constexpr std::string_view fingerprints = "Ashlock & Kim, IEEE Trans. Evolutionary Computation 12, 2008";
constexpr std::string_view noisy_fingerprints = "Ashlock, Kim & Ashlock, IEEE Trans. CIAIG 1, 2009";
constexpr std::string_view optimised = "Ashlock, Brown & Hingston, IEEE Trans. CIAIG 7, 2015";
constexpr std::string_view trained = "Harper et al., PLoS ONE 12(12), 2017";
constexpr std::string_view spreading = "Knight, Harper, Glynatsi & Campbell, PLoS ONE 13(10), 2018";

}  // namespace

// clang-format off
const std::vector<FiniteStrategy>& library_strategies() {
  static const std::vector<FiniteStrategy> strategies{
      {"alexei", {}, "c C c d; d D c d", "C; then their last move", lesswrong, "the entrant also plays D in the last round, whose number a Folk strategy is not told"},
      {"anti_tit_for_tat", {"psycho"}, "mem01_cDC", "C; then the other move than their last one", "Hilbe, Nowak & Traulsen, PLoS ONE 8(11), 2013"},
      {"bully", {"reverse_tit_for_tat"}, "mem01_dDC", "D; then the other move than their last one", "Nachbar, Journal of Economic Behavior & Organization 19(3), 1992"},
      {"two_tits_for_tat", {}, "c C c d; d D d2 d; d2 D c d", "D iff at least one of their last two moves was D", evolution},
      {"hard_tit_for_tat", {}, "c C c d; d D d2 d; d2 D d3 d; d3 D c d", "D iff at least one of their last three moves was D", "prisoners-dilemma.com, 2017"},
      {"hard_tit_for_2_tats", {}, "c C c c2; c2 C c d; d D d2 d; d2 D c c2", "D iff they played D twice in a row in their last three moves", "Stewart & Plotkin, PNAS 109, 2012"},
      {"n_tits_for_m_tats", {"three_tits_for_two_tats"}, "c C c c2; c2 C c d; d D d2 d; d2 D d3 d4; d3 D c c2; d4 D c d", "three D after two D of theirs in a row", harper},
      {"sneaky_tit_for_tat", {}, "c C c2 c3 c4 c5; c2 C d d2 d3 d4; c3 C c3 d2 c5 d4; c4 C d c3 d3 c5; c5 C c3 c3 c5 c5; d D d d2 d3 d4; d2 D c3 d2 c5 d4; d3 D d c3 d3 c5; d4 D c3 c3 c5 c5", "C, C; D until they play D; then tit_for_tat, but C where their D may answer its own of a round before", langner},
      {"spiteful_tit_for_tat", {}, "c C c d; d D c d2; d2 D d2 d2", "tit_for_tat until they have played D twice in a row; then D for ever", prison},
      {"contrite_tit_for_tat", {"ctft", "contrite"}, "c C c d c2 d; d D c d; c2 C c c c2 d2; d2 D c c c2 d2", "tit_for_tat that lets them punish a D of its own that slipped", "Wu & Axelrod, Journal of Conflict Resolution 39(1), 1995"},
      {"eugine_nier", {}, "c C c d; d D c2 d2; c2 C c2 d2; d2 D c3 d3; c3 C c3 d3; d3 D c4 d4; c4 C c4 d4; d4 D c5 d5; c5 C c5 d5; d5 D d5 d5", "tit_for_tat until they have played D five times; then D for ever", lesswrong, "the entrant also plays D in the last round, whose number a Folk strategy is not told"},
      {"appeaser", {}, "c C c d d c; d D c d d c", "C; then changes its move after each D of theirs (which is pavlov)", mueller},
      {"win_shift_lose_stay", {}, "mem11_dDCCD", "D; then D iff both played the same move last round", li},
      {"aon_2", {"all_or_none_2"}, "mem22_ccCDDDDCDDDDCDDDDC", "C, C; then C iff both played the same move in each of the last two rounds", hilbe},
      {"delayed_aon_1", {}, "c C c2 c3 c3 c2; c2 C c2 d d c2; c3 C d2 d d c2; d D d2 d d c2; d2 D c2 d d c2", "C, C; then C iff both played D last round, or both C then and the same move the round before", hilbe},
      {"capri", {}, "c C c d c2 d2; d D d3 d4 c3 d2; c2 C d3 c4 d5 d2; d2 D d3 d6 d7 d8; d3 D c d d9 d2; d4 D d3 d4 d7 d2; c3 C c5 d6 d5 d2; c4 C c5 d4 d7 d2; d5 D d3 d6 d5 d2; d6 D c5 d4 d7 d2; d7 D c5 d6 d5 d2; d8 D c5 c4 c3 d8; d9 D d3 c4 d5 d2; c5 C c d d9 d2", "by the last three rounds: cooperate, accept punishment, punish, recover, in other situations D", "Murase & Baek, Scientific Reports 10, 2020"},
      {"resurrection", {}, "c C c d c2 d2; d D c d c2 d2; c2 C c d c3 d3; d2 D c d c3 d3; c3 C c d c4 d4; d3 D c d c4 d4; c4 C c d c5 d5; d4 D c d c5 d5; c5 C c d d5 d5; d5 D c d d5 d5", "tit_for_tat, but D after five D of its own in a row", coopsim},
      {"double_resurrection", {}, "c C c2 d c3 d2; c2 C c4 d3 c3 d2; d D c4 d3 c3 d2; c3 C c2 d c5 d4; d2 D c2 d c5 d4; c4 C c6 d5 c3 d2; d3 D c6 d5 c3 d2; c5 C c2 d c7 d6; d4 D c2 d c7 d6; c6 C c8 d7 c3 d2; d5 D c8 d7 c3 d2; c7 C c2 d c9 d8; d6 D c2 d c9 d8; c8 C d7 d7 c3 d2; d7 D d7 d7 c3 d2; c9 C c2 d c9 c9; d8 D c2 d c9 c9", "tit_for_tat, but D after five C of its own in a row and C after five D", coopsim},
      {"first_by_nydegger", {"nydegger"}, "c C c2 d c3 d2; c2 C c4 d3 c5 d4; d D d5 d6 d7 d8; c3 C c6 d3 c5 d9; d2 D d5 d3 d7 d8; c4 C c4 c7 c5 c8; d3 D c4 c9 c10 c11; c5 C c6 c7 c5 c12; d4 D c4 c7 c10 c11; d5 D c4 c7 c5 c8; d6 D c4 c9 d7 d8; d7 D d10 d3 d11 d9; d8 D c4 c7 d7 c11; c6 C d5 d3 d11 d4; d9 D c4 d3 d7 d8; c7 C c4 c9 c10 c11; c8 C c4 c7 c10 c11; c9 C c4 c9 d7 d8; c10 C d10 d3 d11 d9; c11 C c4 c7 d7 c11; c12 C c4 d3 d7 d8; d10 D d5 d3 d11 d4; d11 D c6 c7 c5 c12", "opens like tit_for_tat; then by a weighted sum of the last three rounds", first},
      {"first_by_davis", {"davis"}, "c C c2 c3; c2 C c4 c5; c3 C c5 c5; c4 C c6 c7; c5 C c7 c7; c6 C c8 c9; c7 C c9 c9; c8 C c10 c11; c9 C c11 c11; c10 C c12 c13; c11 C c13 c13; c12 C c14 c15; c13 C c15 c15; c14 C c16 c17; c15 C c17 c17; c16 C c18 c19; c17 C c19 c19; c18 C c18 d; c19 C d d; d D d d", "C ten times; then D for ever once they have played D", first},
      {"first_by_grofman", {"grofman"}, "c C c m m c; m 2/7 c m m c", "C; after different moves C with probability 2/7", first},
      {"first_by_joss", {"hard_joss"}, "s C c d; c 0.9 c d; d D c d", "C; then D after D, and after C C with probability 0.9", first},
      {"first_by_anonymous", {}, "m 0.5 m m", "C with a probability drawn anew each round from 0.3 to 0.7, which is lunatic", first},
      {"second_by_colbert", {"colbert"}, "c C c2 c2; c2 C c3 c3; c3 C c4 c4; c4 C c5 c5; c5 C d d; d D c6 c6; c6 C c7 c7; c7 C c7 d2; d2 D d d", "C but for a D in round 6; then answers a D by D, D, C, C", second},
      {"second_by_tester", {"tester"}, "d D c c2; c C c3 c2; c2 C c2 d2; c3 C d3 c2 c3 c2; d2 D c2 d2; d3 D d3 c2 c3 c2", "D, C, C, then D and C in turn until their first D; then C and tit_for_tat", second},
      {"aggravater", {}, "d D d2 d3; d2 D d4 d3; d3 D d3 d3; d4 D c d3; c C c d3", "D three times; then D for ever once they have played D", campbell},
      {"easy_go", {"reverse_grudger"}, "d D d c; c C c c", "D until they have played D; then C for ever", prison},
      {"opposite_grudger", {}, "d D c d; c C c c", "D until they have played C; then C for ever", palmer},
      {"fool_me_once", {}, "c C c c2; c2 C c2 d; d D d d", "C until they have played D twice; then D for ever", harper},
      {"back_stabber", {}, "c C c c2; c2 C c2 c3; c3 C c3 c4; c4 C c4 d; d D d d", "C until they have played D four times; then D for ever", campbell, "Axelrod-Python's also plays D in the last two rounds of a match whose length it knows"},
      {"forgetful_grudger", {}, "c C c d; d D d2 d2; d2 D d3 d3; d3 D d4 d4; d4 D d5 d5; d5 D d6 d6; d6 D d7 d7; d7 D d8 d8; d8 D d9 d9; d9 D d10 d10; d10 D c d", "C; ten D after a D of theirs, then looks at their last move again", palmer},
      {"once_bitten", {}, "c C c c2; c2 C c d; d D d2 d2; d2 D d3 d3; d3 D d4 d4; d4 D d5 d5; d5 D d6 d6; d6 D d7 d7; d7 D d8 d8; d8 D d9 d9; d9 D d10 d10; d10 D d11 d12; d11 D c c2; d12 D c d", "C until they play D twice in a row; then eleven D", marissa},
      {"soft_grudger", {}, "c C c d; d D d2 d2; d2 D d3 d3; d3 D d4 d4; d4 D c2 c2; c2 C c c", "answers a D by D, D, D, D, C, C", li},
      {"general_soft_grudger", {}, "c C c d; d D d2 d2; d2 D d3 d3; d3 D d4 d4; d4 D c2 c2; c2 C c c", "answers one D by four D and two C, by default (which is soft_grudger)", taylor_smith},
      {"grudger_alternator", {"c_then_per_dc"}, "c C c d c c2; d D d d c2 c2; c2 C d d c2 c2", "C until they have played D; then the other move than its own last one", prison},
      {"collective_strategy", {}, "c C d d2; d D d2 c2; d2 D d2 d2; c2 C c2 d2", "C, D; then C with who opened so too, until they play D again; else D", "Li & Kendall, Evolutionary Computation 17(2), 2009"},
      {"handshake", {}, "c C d d2; d D d2 c2; d2 D d2 d2; c2 C c2 c2", "C, D; then C with who opened so too, else D", "Robson, Journal of Theoretical Biology 144(3), 1990"},
      {"detective", {}, "c C d d2; d D c2 c3; d2 D c3 c3; c2 C c4 c5; c3 C c5 c5; c4 C d3 d4; c5 C c5 d4; d3 D d3 d3; d4 D c5 d4", "C, D, C, C; then D if they have played no D, else tit_for_tat", "Case, The Evolution of Trust, 2017"},
      {"prober_2", {}, "d D c c; c C c2 c3; c2 C c2 d2; c3 C c4 d2; d2 D c2 d2; c4 C c4 c4", "D, C, C; then all_c if they played D, C in rounds 2 and 3, else tit_for_tat", prison},
      {"prober_3", {}, "d D c c; c C d2 d3; d2 D d2 d2; d3 D c2 d3; c2 C c2 d3", "D, C; then all_d if they played C in round 2, else tit_for_tat", prison},
      {"hard_prober", {}, "d D d2 d2; d2 D c c2; c C c3 c4; c2 C c4 c4; c3 C d3 d3; c4 C c4 d4; d3 D d3 d3; d4 D c4 d4", "D, D, C, C; then all_d if they played C in rounds 2 and 3, else tit_for_tat", prison},
      {"gradual_killer", {}, "d D d2 d2; d2 D d3 d3; d3 D d4 d4; d4 D d5 d5; d5 D c c; c C c2 c3; c2 C c2 c2; c3 C c2 d6; d6 D d6 d6", "D five times, C, C; then all_d if they played D in rounds 6 and 7, else all_c", prison},
      {"tricky_cooperator", {}, "c C c2 c3; c2 C c4 c3; c3 C c5 c3; c4 C d c3; c5 C c6 c3; d D d c3; c6 C c7 c3; c7 C c8 c3; c8 C c9 c3; c9 C c10 c3; c10 C c c3", "C three times; then D unless they have played D in the last ten rounds", langner},
      {"tricky_defector", {}, "d D d2 d; d2 D d2 d3; d3 D d2 d4; d4 D d2 c; c C d2 c", "D, but C after three D of theirs if they have ever played C", langner},
      {"per_dc", {"CyclerDC"}, "per_dc", "D, C, for ever", harper},
      {"per_cccd", {"CyclerCCCD"}, "per_cccd", "C, C, C, D, for ever", harper},
      {"per_cccccd", {"CyclerCCCCCD"}, "per_cccccd", "C five times, D, for ever", harper},
      {"per_cccdcd", {"CyclerCCCDCD"}, "per_cccdcd", "C, C, C, D, C, D, for ever", harper},
      {"fortress_3", {}, "d D d d2; d2 D d c; c C c d", "D until they play D twice in a row; then C as long as they do", ashlock},
      {"fortress_4", {}, "d D d d2; d2 D d d3; d3 D d c; c C c d", "D until they play D three times in a row; then C as long as they do", ashlock},
      {"predator", {}, "c C d d2; d D d d2; d2 D d3 d4; d3 D c2 d4; d4 D d5 c2; c2 C c3 d6; d5 D d7 d4; c3 C c2 d4; d6 D c4 d7; d7 D d8 d7; c4 C d8 d7; d8 D d8 d6", "an evolved machine that lives on others of its time", ashlock},
      {"pun_1", {}, "d D c c; c C c2 d; c2 C c c", "D, C; then their last move and C in turn", "Ashlock, Kim & Leahy, IEEE Trans. Systems, Man and Cybernetics C 36(4), 2006"},
      {"raider", {}, "d D d2 d2; d2 D d c; c C d c2; c2 C c2 d3; d3 D c2 d3", "an evolved machine that exploits", "Ashlock, Tsang & Ashlock, IEEE FOCI, 2014"},
      {"ripoff", {}, "d D c c2; c C d c2; c2 C c2 d2; d2 D c2 d2", "D and C in turn until their first D; then C and tit_for_tat", fingerprints},
      {"usually_cooperates", {}, "c C c c2; c2 C d c; d D c c2", "C, but D when a D of theirs is followed by C", noisy_fingerprints},
      {"usually_defects", {}, "d D d2 d; d2 D d c; c C d2 d", "D, but C when a C of theirs is followed by D", noisy_fingerprints},
      {"solution_b1", {}, "d D d2 d; d2 D c c; c C c c", "D until they have played C, and once more; then C for ever", optimised},
      {"solution_b5", {}, "d D c d2; c C c d3; d2 D c2 d4; d3 D c3 d; c2 C c3 d; d4 D d4 d5; c3 C c2 d4; d5 D c2 d2", "an evolved machine of six inner states", optimised},
      {"thumper", {}, "c C c d; d D d2 d2; d2 D c d", "C; answers a D by D, D, the second whatever they do", fingerprints},
      {"evolved_fsm_4", {}, "c C c d; d D d c2; c2 C d2 c; d2 D d2 d3; d3 D d2 c", "a trained machine of 4 inner states", trained},
      {"evolved_fsm_6", {}, "c C c d; d D c2 d2; c2 C d c; d2 D d2 d3; d3 D c3 d4; c3 C d2 d3; d4 D d c", "a trained machine of 6 inner states", "Vincent & Fryer, in Axelrod-Python 4.13.0"},
      {"evolved_fsm_16", {}, "c C c d; d D c2 d2; c2 C c3 c3; d2 D d3 d4; c3 C d d5; d3 D d3 c4; d4 D d d5; d5 D d2 c2; c4 C d6 d7; d6 D d6 d7; d7 D d8 d8; d8 D d8 d9; d9 D d10 c5; d10 D d10 d10; c5 C d10 c6; c6 C c3 d", "a trained machine of 16 inner states", trained},
      {"evolved_fsm_16_noise_05", {}, "c C c2 d; c2 C c3 d2; d D c4 d; c3 C c5 d; d2 D d3 d2; c4 C d2 d4; c5 C c6 c3; d3 D d2 d5; d4 D c6 d6; c6 C c6 c7; d5 D d2 d4; d6 D d3 c8; c7 C c2 d7; c8 C d8 c6; d7 D c2 d7; d8 D d d9; d9 D c6 c7", "a machine of 16 inner states trained with 5 % of moves slipping", trained},
      {"tf1", {}, "c C c2 c3; c2 C d d2; c3 C d3 d3; d D c4 c5; d2 D d4 c6; d3 D d5 d6; c4 C d7 c7; c5 C c5 d8; d4 D d9 d4; c6 C d9 d4; d5 D d7 c7; d6 D c8 d4; d7 D d10 d4; c7 C d4 d7; d8 D d5 d10; d9 D d4 d7; c8 C d5 d6; d10 D c d11; d11 D c6 c9; c9 C c10 c11; c10 C c4 c5; c11 C c8 d4", "a machine trained to spread through populations, the first", spreading},
      {"tf2", {}, "c C d d2; d D c2 d3; d2 D c3 d4; c2 C d2 d5; d3 D c4 c5; c3 C c d6; d4 D d7 d8; d5 D d9 d8; c4 C d9 d8; c5 C c5 d10; d6 D d11 d12; d7 D d2 d5; d8 D d4 d13; d9 D d3 d7; d10 D d7 d; d11 D c d6; d12 D d6 d5; d13 D d d2", "a machine trained to spread through populations, the second", spreading},
      {"tf3", {}, "c C c c2; c2 C d d2; d D c2 d3; d2 D d2 d2; d3 D d4 c; d4 D c3 d5; c3 C d2 d2; d5 D d d2", "a machine trained to spread through populations, the third", spreading},
      {"evolved_looker_up_1_1_1", {}, "c C c2 d d2 d; c2 C c2 d2 d2 d2; d D d d c3 d; d2 D c2 d2 d2 d2; c3 C d d c3 d", "a trained table of both last moves and their first", trained},
      {"evolved_looker_up_2_2_2", {}, "c C c2 c3 c4 c5; c2 C c6 c7 d d2; c3 C d3 d4 d5 d6; c4 C d7 c7 d c8; c5 C c9 d4 d5 d6; c6 C c6 d8 d c10; c7 C d9 d10 d11 d2; d D d7 c11 d c10; d2 D d9 d10 d11 c8; d3 D d3 d12 c12 c13; d4 D d13 d4 c14 d6; d5 D c9 c15 d5 d14; d6 D d13 d4 d15 d6; d7 D c6 d8 d c10; c8 C d9 d10 d11 c8; c9 C d3 d12 c12 c13; d8 D c6 c11 c16 c10; c10 C d7 d8 c16 c10; d9 D d9 c7 d11 d2; d10 D d9 d10 d11 d2; d11 D d9 c7 d11 c8; c11 C c6 c11 c16 c10; d12 D d3 d12 d5 c13; c12 C c9 c15 d5 d14; c13 C c9 d12 d5 c13; d13 D c17 d4 d15 c18; c14 C c17 d4 d15 d6; c15 C d3 d12 d5 c13; d14 D c9 d12 d5 c13; d15 D c17 d4 d15 d6; c16 C d7 c11 d c10; c17 C c17 d4 d15 c18; c18 C d13 d4 d15 d6", "a trained table of both sides' last two moves and their first two", trained},
      {"negation", {}, "m 0.5 d c; c C d c; d D d c", "C with probability 1/2; then the other move than their last one", "prisoners-dilemma.com, 2017"},
      {"desperate", {}, "m 0.5 d d d c; c C d d d c; d D d d d c", "C with probability 1/2; then C only after both played D", berg},
      {"hopeless", {}, "m 0.5 d c c c; c C d c c c; d D d c c c", "C with probability 1/2; then D only after both played C", berg},
      {"willing", {}, "m 0.5 c c c d; c C c c c d; d D c c c d", "C with probability 1/2; then D only after both played D", berg},
      {"all_c_or_all_d", {}, "m 0.6 c c d d; c C c c d d; d D c c d d", "C with probability 3/5; then its own last move", harper},
      {"random_tit_for_tat", {}, "s C c d; c C m m; d D m m; m 0.5 c d", "C; then C with probability 1/2 and their last move in turn, that first", "Zachary M. Taylor, in Axelrod-Python 4.13.0"},
  };
  return strategies;
}
// clang-format on

}  // namespace folk
