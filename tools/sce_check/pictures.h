#pragma once
// The pictures of sce-check's page, each inside the page as an image of its own.

#include <folk/tools/program/html.h>
#include <folk/tools/sce_check/report.h>

#include <folk/analysis/pictures/caption.h>
#include <folk/strategies/automaton.h>

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace folk::tools {

/// Machines with more states are not drawn.
inline constexpr std::size_t most_drawn_states = 60;

/// Draws pictures by gnuplot and dot. Where one of them is missing, a picture is a line that says so.
class Pictures {
public:
  /// Makes a temporary folder, which goes away with this. `caption` says what was played. Throws EnvironmentError where
  /// no folder can be made.
  explicit Pictures(Caption caption);
  ~Pictures();
  Pictures(const Pictures&) = delete;
  Pictures& operator=(const Pictures&) = delete;

  /// What one match believed in; nothing from a policy without beliefs.
  Html beliefs(const OpponentReport& report, const std::string& policy) const;

  /// Of all opponents together; nothing from a policy without beliefs.
  Html accuracy(const SceReport& report) const;
  Html calibration(const SceReport& report) const;

  /// Of any machine its smallest automaton, or a line that says why there is none.
  Html machine(const std::string& name, const Machine& machine) const;

  /// `automaton` is minimal in this sense; `state_names` as in DrawingOptions.
  Html automaton(const std::string& name, const Automaton& automaton, Sense sense,
                 std::vector<std::vector<std::string>> state_names = {}) const;

private:
  /// The .svg that `draw` writes as an element of this class; `words` are for who cannot see it.
  Html picture(const std::string& css_class, const std::string& words,
               const std::function<void(const std::filesystem::path&)>& draw) const;

  Caption caption_;
  std::filesystem::path folder_;
};

}  // namespace folk::tools
