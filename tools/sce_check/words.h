#pragma once
// What sce-check found, in words and numbers for people.

#include <folk/tools/program/html.h>
#include <folk/tools/program/number_text.h>
#include <folk/tools/sce_check/output.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace folk::tools {

/// "the policy" or the opponent's name.
std::string side_text(const std::string& policy, const std::string& opponent, Seat side);

/// "Nash", "subgame perfect", ...
std::string_view title_of(Notion notion);

/// A gap, exact where it is, with >= where it is a lower bound; "-" where it is unknown.
std::string gap_text(const std::optional<Gap>& gap);

/// How the numbers of one column are written: all whole, or all with four digits behind the point.
class ColumnForm {
public:
  void add(double value);
  void add(const std::optional<Gap>& gap) {
    if (gap) add(gap->gain);
  }

  /// Of nothing a dash; of a lower bound with >=.
  std::string text(double value) const;
  std::string text(const std::optional<Gap>& gap) const;

private:
  bool whole_ = true;
};

/// The notion in a sentence.
std::string meaning_of(Notion notion);

/// What is said where there is no judgement: a notion of beliefs does not apply to a policy that tells none.
std::string_view absence_words(Notion notion, bool believes);

/// One of the three words with its sign and colour, and how far was looked; `absent` without a judgement.
Html word_of(const std::optional<Certificate>& verdict, std::string_view absent);

/// The sign alone.
Html sign_of(const std::optional<Certificate>& verdict, std::string_view absent);

/// "2 (own)": how much is gained, or how far beliefs are from the truth.
std::string margin_text(Notion notion, const Certificate& verdict);

/// What is played: "(CC)x99 CD", and where it goes on. No more than the first `most` rounds. `before`: rounds that were
/// played before the path.
std::string path_words(const PlayPath& path, std::size_t most, std::size_t before = 0);

/// From which round on a notion holds: "3", "3?" where it is only not refuted, "never", and "-" where it is unknown.
std::string settled_text(const std::optional<Settled>& settled);

/// "from round 3 on", where that is asked, after a comma; else nothing.
std::string from_words(const SceQuestion& question);

/// "3, 7-9, 100" of ascending rounds; "none".
std::string rounds_words(const std::vector<std::uint64_t>& rounds);

/// What shows a claim, as a whole phrase.
std::string witness_words(Notion notion, const std::string& witness);

/// How a gain is had, or why there is none, and how far was looked.
std::string how_words(Notion notion, const Gap& gap);

/// "at 1/2: the policy, after CC, plays D, then ..."; a piece for each end that a deviation makes.
std::vector<std::string> binding_words(const Threshold& threshold, const std::string& policy,
                                       const std::string& opponent);

}  // namespace folk::tools
