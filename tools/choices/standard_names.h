#pragma once
// The names that every program knows.

#include <folk/sct/policy/sct_player.h>
#include <folk/strategies/registry.h>

#include <functional>
#include <string>
#include <vector>

namespace folk::tools {

/// Registry::standard() and the strategies of the folders above it: bayes(SPEC), sct, sct-bayes, sct:FILE. `options`
/// says how policies play; "@-" is a machine file on the standard input.
Registry standard_names(const sct::PlayOptions& options = {});

/// While one lives, the names that this thread asks for hold what `add` adds too: who asks the programs' questions from
/// inside another program (python/) has strategies of its own. The latest counts.
class MoreNames {
public:
  explicit MoreNames(std::function<void(Registry&)> add);
  ~MoreNames();
  MoreNames(const MoreNames&) = delete;
  MoreNames& operator=(const MoreNames&) = delete;

private:
  friend Registry standard_names(const sct::PlayOptions& options);

  static thread_local const MoreNames* latest;

  std::function<void(Registry&)> add_;
  const MoreNames* before_;
};

/// A roster, made of one SPEC, and after it the entrants of another. What rosters and families of the two share is
/// there once. Throws UsageError for what is named in both.
std::vector<Strategy> with_guests(const Registry& registry, std::vector<Strategy> roster, const std::string& spec,
                                  const std::string& guests_spec, const Payoffs& payoffs);

}  // namespace folk::tools
