#pragma once
// The judgements of all notions, and how those of several pairs add up: a claim about all is as good as its worst pair.

#include <folk/analysis/equilibria/certificate.h>
#include <folk/analysis/equilibria/equilibrium_check.h>
#include <folk/games/rational.h>

#include <array>
#include <cstddef>
#include <optional>
#include <string>

namespace folk {

/// A judgement of each notion, in the order of all_notions; nothing where a notion does not apply.
using Certificates = std::array<std::optional<Certificate>, all_notions.size()>;

/// The place of a notion there.
constexpr std::size_t place_of(Notion notion) { return static_cast<std::size_t>(notion); }

/// `judge` for every notion that is about gains. `epsilon` is in the criterion's unit.
Certificates judge_all(const PairGaps& gaps, Sides sides, const Rational& epsilon);

/// The judgements of several pairs as they come: of each notion the worst is kept. Refuted is worse than not refuted,
/// and that worse than certified; of equal words the larger margin is, then the earlier pair.
class VerdictSummary {
public:
  /// The judgements of one more pair, which is called `name`.
  void add(const Certificates& verdicts, const std::string& name);

  /// The worst. What is certified for some pairs and undecided for others is not refuted, and its scope says for how
  /// many nothing is known. Nothing where it is so for all.
  Certificates overall() const;

  /// Whose judgement each of these is; empty where there is none.
  const std::array<std::string, all_notions.size()>& worst() const { return worst_; }

private:
  Certificates verdicts_{};
  std::array<std::string, all_notions.size()> worst_{};
  std::array<std::size_t, all_notions.size()> undecided_{};
};

}  // namespace folk
