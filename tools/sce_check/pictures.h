#pragma once
// The pictures of sce-check's page, each inside the page as an image of its own.

#include <folk/tools/program/html.h>
#include <folk/tools/sce_check/report.h>

#include <folk/strategies/automaton.h>

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

namespace folk::tools {

/// Machines with more states are not drawn.
inline constexpr std::size_t most_drawn_states = 60;

/// Draws pictures by gnuplot and dot. Where one of them is missing, a picture is a line that says so.
class Pictures {
public:
  /// Makes a temporary folder, which goes away with this. Throws EnvironmentError where none can be made.
  Pictures();
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

  /// `automaton` is minimal in this sense.
  Html automaton(const std::string& name, const Automaton& automaton, Sense sense) const;

private:
  /// The .svg that `draw` writes as an element of this class; `words` are for who cannot see it.
  Html picture(const std::string& css_class, const std::string& words,
               const std::function<void(const std::filesystem::path&)>& draw) const;

  std::filesystem::path folder_;
};

}  // namespace folk::tools
