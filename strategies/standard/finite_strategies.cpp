#include <folk/strategies/standard/finite_strategies.h>

namespace folk {
namespace {

constexpr std::string_view classic = "Mathieu & Delahaye, JASSS 20(4) 12, 2017";
constexpr std::string_view axelrod = "Axelrod-Python 4.13.0";
constexpr std::string_view mathieu = "cristal-smac/ipd at 40c86c7, the program of Mathieu & Delahaye";

}  // namespace

// clang-format off
const std::vector<FiniteStrategy>& finite_strategies() {
  static const std::vector<FiniteStrategy> strategies{
      {"all_c", {"Cooperator", "AllC"}, "c C c c", "always C", classic},
      {"all_d", {"Defector", "AllD"}, "d D d d", "always D", classic},
      {"tit_for_tat", {"tft"}, "c C c d; d D c d", "C; then their last move", "Rapoport, in Axelrod, The Evolution of Cooperation, 1984"},
      {"spiteful", {"grim", "grim_trigger"}, "c C c d d d; d D d d", "C until either side has played D; then D for ever", "Friedman, Review of Economic Studies 38, 1971", "the program of Mathieu & Delahaye looks back one round, and once a move of its own slips it may forgive: mathieu_spiteful"},
      {"per_ddc", {"CyclerDDC"}, "per_ddc", "D, D, C, for ever", classic},
      {"per_ccd", {"CyclerCCD"}, "per_ccd", "C, C, D, for ever", classic},
      {"mistrust", {"SuspiciousTitForTat", "stft"}, "d D c d; c C c d", "D; then their last move", classic},
      {"per_cd", {}, "per_cd", "C, D, for ever", classic, "Axelrod-Python's Alternator goes by its own last move, and once that slips it is another: axelrod_alternator"},
      {"pavlov", {"win_stay_lose_shift", "wsls"}, "c C c d d c; d D c d d c", "C; then C iff both played the same move last round", "Nowak & Sigmund, Nature 364, 1993"},
      {"tf2t", {"TitFor2Tats", "tit_for_two_tats"}, "a C a b; b C a d; d D a d", "C, C; then D iff their last two moves were both D", classic},
      {"hard_tft", {}, "mem02_ccCDDD", "C, C; then D iff at least one of their last two moves was D", classic},
      {"slow_tft", {"SlowTitForTwoTats2"}, "mem12_ccCCCDCDDD", "C, C; then copies their move once they have played it twice in a row, else repeats its own", classic},
      {"prober", {}, "r1 D r2 r2; r2 C r3 s3; r3 C x d; s3 C c d; x D x x; c C c d; d D c d", "D, C, C; then all_d if they played C in rounds 2 and 3, else tit_for_tat", classic},
      {"grudger", {}, "c C c d; d D d d", "C until they have played D; then D for ever (blind to its own D)", axelrod},
      {"spiteful_cc", {}, "mem12_ccCDCDDDDD", "C, C; then D iff own last or their last move was D", classic, "Axelrod-Python's SpitefulCC forgives no D, be it in round 1, and sees none of its own: axelrod_spiteful_cc"},
      {"tft_spiteful", {}, "s C c y; y C c x; c C c d; d D c x; x D x x", "C, C; then tit_for_tat until they have played D twice in a row; then D for ever", classic},
      {"winner12", {}, "mem12_ccCDCDDCDD", "C, C; then by own last and their last two moves", classic},
      {"winner21", {}, "mem21_dcCDCDCDDD", "D, C; then by own last two and their last move", classic, "Axelrod-Python's Winner21 goes by its own last and their last two moves: axelrod_winner21"},
      {"lunatic", {}, "m 0.5 m m", "C with probability 1/2", classic},
      {"axelrod_alternator", {"Alternator"}, "mem11_cDDCC", "C; then the other move than its own last one", axelrod},
      {"axelrod_spiteful_cc", {}, "s C c x; c C c d; x C d d; d D d d", "C, C; then D for ever if they have ever played D (blind to its own D)", axelrod},
      {"axelrod_winner21", {}, "mem12_dcCDCDCDDD", "D, C; then by own last and their last two moves", axelrod},
      {"mathieu_spiteful", {}, "mem11_cCDDD", "C; then D iff own last or their last move was D", mathieu},
  };
  return strategies;
}
// clang-format on

}  // namespace folk
