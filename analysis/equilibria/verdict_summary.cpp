#include <folk/analysis/equilibria/verdict_summary.h>

#include <fmt/format.h>

namespace folk {
namespace {

/// Worse comes later.
int badness(Verdict verdict) { return verdict == Verdict::certified ? 0 : verdict == Verdict::not_refuted ? 1 : 2; }

bool is_worse(const Certificate& a, const Certificate& b) {
  return a.verdict == b.verdict ? a.margin > b.margin : badness(a.verdict) > badness(b.verdict);
}

}  // namespace

Certificates judge_all(const PairGaps& gaps, Sides sides, const Rational& epsilon) {
  Certificates verdicts;
  for (const Notion notion : all_notions)
    if (notion != Notion::beliefs) verdicts[place_of(notion)] = judge(gaps, notion, sides, epsilon);
  return verdicts;
}

void VerdictSummary::add(const Certificates& verdicts, const std::string& name) {
  for (std::size_t n = 0; n < all_notions.size(); ++n) {
    if (!verdicts[n]) {
      ++undecided_[n];
    } else if (!verdicts_[n] || is_worse(*verdicts[n], *verdicts_[n])) {
      verdicts_[n] = verdicts[n];
      worst_[n] = name;
    }
  }
}

Certificates VerdictSummary::overall() const {
  Certificates overall = verdicts_;
  for (std::size_t n = 0; n < all_notions.size(); ++n) {
    if (!overall[n] || overall[n]->verdict != Verdict::certified || undecided_[n] == 0) continue;
    overall[n]->verdict = Verdict::not_refuted;
    overall[n]->scope = fmt::format("undecided for {} opponents", undecided_[n]);
  }
  return overall;
}

}  // namespace folk
