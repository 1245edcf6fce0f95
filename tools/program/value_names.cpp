#include <folk/tools/program/value_names.h>

#include <array>
#include <string_view>
#include <utility>

namespace folk::tools {
namespace {

/// Options of all programs, or of one ("sct-train output").
struct Values {
  std::string_view name;
  std::string_view options;  // between blanks
};

constexpr std::array all_values{
    Values{
        "N",
        " threads seed repetitions rounds horizon most-pairs width data-repetitions aggregate-every "
        "aggregate-repetitions steps hidden layers heads context batch warmup evaluate-every validation-repetitions "
        "validation-seed checkpoint-every depth episodes numpy-seed selection-seed episode transitions first-episode "
        "memory first-update update-every evaluation-episodes patience population "
        "individuals generations runs evaluations most-kinds sample "
        "explore-every explore-matches remembered plan-depth "},
    Values{"X",
           " regret-temperature situation-temperature learning-rate final-learning-rate weight-decay clip return-scale "
           "return-jitter tolerance action-penalty conservatism imitation target-noise target-noise-clip discount "
           "epsilon-belief epsilon-payoff exploration final-exploration averaging dropout early resilience intensity "},
    Values{"P", " noise end-probability validation-noise aggregate-slip opponent-slip mutation "},
    Values{"SPEC", " strategies include exclude opponents entrants class roster held-out "},
    Values{"FILE", " game config log output curve record render replay medium prey-output picture tournament journal "},
    Values{"DIR",
           " data checkpoint ipd-tournament_output ipd-evolve_output sce-check_output mpe-evaluate_output "
           "mpe-train_collect_output "
           "mpe-train_study_output "},
    Values{"T=,R=,P=,S=", " payoffs "},
    Values{"CRITERION", " criterion "},
    Values{"FORMAT", " format plot "},
    Values{"MIN,MAX", " scale "},
    Values{"N[:SAMPLES]", " sub-rosters "},
    Values{"K|settled", " from "},
    Values{"PLAYER", " predators prey "},
    Values{"LIST", " targets mpe-train_study_only mpe-train_study_seeds seeds mark start "},
    Values{
        "NAME",
        " side require loss scenario reward-rule level dtype learner budget readout algorithm critic references title "
        "decay only model income fitness return-token "},
};

}  // namespace

std::string value_name(const std::string& program, const std::string& option) {
  std::string own = program + "_" + option;
  for (char& c : own)
    if (c == ' ') c = '_';
  for (const std::string& key : {own, option})
    for (const auto& [name, options] : all_values)
      if (options.find(" " + key + " ") != std::string_view::npos) return std::string(name);
  return "VALUE";
}

void name_values(const std::string& program, const boost::program_options::options_description& options) {
  namespace po = boost::program_options;
  for (const auto& option : options.options()) {
    // The description hands out const what it was given as an object of ours.
    const auto semantic = boost::const_pointer_cast<po::value_semantic>(option->semantic());
    if (auto* value = dynamic_cast<po::typed_value<std::string>*>(semantic.get()))
      value->value_name(value_name(program, option->long_name()));
  }
}

}  // namespace folk::tools
