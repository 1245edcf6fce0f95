#include <folk/analysis/equilibria/certificate.h>
#include <folk/games/outcome.h>

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

namespace folk {
namespace {

std::string scope_of(const Gap& gap) {
  if (!gap.tried.empty()) return gap.tried;
  if (gap.depth) return fmt::format("depth {}", *gap.depth);
  return fmt::format("rounding {:.1g}", gap.residual);
}

/// More than `epsilon` is gained for certain.
bool refutes(const Gap& gap, const Rational& epsilon) {
  return gap.exact ? *gap.exact > epsilon : gap.gain - gap.residual > to_double(epsilon);
}

/// No more than `epsilon` is gained for certain.
bool allows(const Gap& gap, const Rational& epsilon) {
  if (gap.bounded()) return false;
  return gap.exact ? *gap.exact <= epsilon : gap.gain + gap.residual <= to_double(epsilon);
}

/// Tells gains apart that are too small for doubles.
bool larger(const Gap& a, const Gap& b) {
  return a.gain == b.gain && a.exact && b.exact ? *a.exact > *b.exact : a.gain > b.gain;
}

struct SideGap {
  Seat side;
  const std::optional<Gap>* gap;
};

std::vector<SideGap> asked(const PairGaps& gaps, Notion notion, Sides sides) {
  std::vector<SideGap> asked;
  if (sides != Sides::second) asked.push_back({Seat::first, &gap_of(gaps.first, notion)});
  if (sides != Sides::first) asked.push_back({Seat::second, &gap_of(gaps.second, notion)});
  return asked;
}

Certificate certificate(Seat side, const Gap& gap, Verdict verdict) {
  const std::string exact = gap.exact ? to_text(*gap.exact) : "";
  return {verdict, {}, side, gap.gain, exact, gap.witness.reply, witness_text(gap)};
}

}  // namespace

std::string_view to_string(Notion notion) {
  switch (notion) {
    case Notion::nash: return "nash";
    case Notion::subgame_perfect: return "subgame_perfect";
    case Notion::self_confirming_unrestricted: return "self_confirming_unrestricted";
    case Notion::self_confirming_class: return "self_confirming_class";
    case Notion::self_confirming_own: return "self_confirming_own";
    case Notion::beliefs: return "beliefs";
  }
  throw std::logic_error("unknown notion");
}

std::string Certificate::text() const {
  if (verdict == Verdict::certified) return "certified";
  return verdict == Verdict::refuted ? "refuted" : "not refuted (" + scope + ")";
}

const std::optional<Gap>& gap_of(const SideGaps& gaps, Notion notion) {
  static const std::optional<Gap> none;
  switch (notion) {
    case Notion::nash: return gaps.nash;
    case Notion::subgame_perfect: return gaps.subgame_perfect;
    case Notion::self_confirming_unrestricted: return gaps.self_confirming_unrestricted;
    case Notion::self_confirming_class: return gaps.self_confirming_class;
    case Notion::self_confirming_own: return gaps.self_confirming_own;
    case Notion::beliefs: break;
  }
  return none;
}

std::optional<Certificate> judge(const PairGaps& gaps, Notion notion, Sides sides, const Rational& epsilon) {
  const SideGap* worst = nullptr;
  const SideGap* open = nullptr;  // not decided in its favour
  // Only one side may hold beliefs of its own.
  const bool one_is_enough = notion == Notion::self_confirming_own;
  const auto candidates = asked(gaps, notion, sides);
  for (const auto& candidate : candidates) {
    if (!*candidate.gap) {
      if (!one_is_enough) open = &candidate;
      continue;
    }
    const Gap& gap = **candidate.gap;
    if (worst == nullptr || larger(gap, **worst->gap)) worst = &candidate;
    if (!allows(gap, epsilon)) open = &candidate;
  }
  if (worst != nullptr && refutes(**worst->gap, epsilon))
    return certificate(worst->side, **worst->gap, Verdict::refuted);
  if (notion == Notion::subgame_perfect) {
    auto nash = judge(gaps, Notion::nash, sides, epsilon);
    if (nash && nash->verdict == Verdict::refuted) return nash;
  }
  if (worst == nullptr) return std::nullopt;
  if (open == nullptr) return certificate(worst->side, **worst->gap, Verdict::certified);
  Certificate result = certificate(worst->side, **worst->gap, Verdict::not_refuted);
  result.scope =
      *open->gap ? scope_of(**open->gap) : fmt::format("{} side unknown", open->side == Seat::first ? "own" : "their");
  return result;
}

std::optional<Certificate> judge_beliefs(const BeliefConsistency& beliefs, double epsilon, bool whole_path) {
  if (beliefs.rounds == 0) return std::nullopt;
  Certificate result;
  result.verdict = Verdict::certified;
  result.margin = beliefs.largest_distance;
  if (!beliefs.wrong_rounds.empty())
    result.witness = fmt::format("the likelier move is wrong in {} of {} rounds, first in round {}",
                                 beliefs.rounds - beliefs.right, beliefs.rounds, beliefs.wrong_rounds.front());
  if (beliefs.largest_distance > epsilon) {
    result.verdict = Verdict::refuted;
    if (result.witness.empty())
      result.witness = fmt::format("a belief is {:.4g} from the truth", beliefs.largest_distance);
  } else if (!whole_path) {
    result.verdict = Verdict::not_refuted;
    result.scope = fmt::format("{} sampled matches", beliefs.matches);
  }
  return result;
}

std::string history_text(const std::vector<Outcome>& history) {
  std::string text;
  for (std::size_t t = 0; t < history.size();) {
    // The repetition that shortens most, of up to 8 rounds at a time.
    std::size_t period = 1;
    std::size_t times = 1;
    for (std::size_t length = 1; length <= 8 && t + length <= history.size(); ++length) {
      std::size_t end = t + length;
      while (end < history.size() && history[end] == history[end - length]) ++end;
      const std::size_t laps = (end - t) / length;
      if (laps >= 3 && laps * length > times * period) {
        period = length;
        times = laps;
      }
    }
    std::string lap;
    for (std::size_t i = t; i < t + period; ++i) {
      if (!lap.empty()) lap += ' ';
      lap += to_char(history[i].own);
      lap += to_char(history[i].theirs);
    }
    if (!text.empty()) text += ' ';
    text += times > 1 ? fmt::format("({})x{}", lap, times) : lap;
    t += period * times;
  }
  return text;
}

std::string witness_text(const Gap& gap) {
  const Witness& witness = gap.witness;
  if (!witness.deviation) return witness.belief.empty() && gap.gain > 0 ? witness.then : witness.belief;
  std::string text = fmt::format("in round {}", witness.history.size() + 1);
  if (!witness.history.empty()) text += ", after " + history_text(witness.history);
  text += fmt::format(", plays {}, then {}", to_char(*witness.deviation), witness.then);
  return witness.belief.empty() ? text : witness.belief + ": " + text;
}

}  // namespace folk
