#include <folk/tools/description/value_names.h>

#include <algorithm>
#include <array>
#include <sstream>
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
        "individuals generations runs evaluations most-kinds sample show "
        "explore-every explore-matches remembered time-rows plan-depth "},
    Values{"X",
           " regret-temperature situation-temperature learning-rate final-learning-rate weight-decay clip return-scale "
           "return-jitter tolerance action-penalty conservatism imitation target-noise target-noise-clip discount "
           "epsilon-belief epsilon-payoff exploration final-exploration averaging dropout early resilience intensity "},
    Values{"P", " noise end-probability validation-noise aggregate-slip opponent-slip mutation "},
    Values{"SPEC", " player name command strategies include exclude opponents entrants class roster held-out "},
    Values{
        "FILE",
        " file files game config log output curve record render replay medium prey-output picture tournament journal "},
    Values{"DIR",
           " folder data checkpoint ipd-tournament_output ipd-evolve_output ipd-judge_output sce-check_output "
           "mpe-evaluate_output "
           "mpe-train_collect_output "
           "mpe-train_study_output "},
    Values{"T=,R=,P=,S=", " payoffs "},
    Values{"CRITERION", " criterion "},
    Values{"FORMAT", " format plot "},
    Values{"MIN,MAX", " scale "},
    Values{"N[:SAMPLES]", " sub-rosters "},
    Values{"K|settled", " from "},
    Values{"PLAYER", " predators prey "},
    Values{"LIST", " targets mpe-train_study_only mpe-train_study_seeds seeds mark start slips "},
    Values{
        "NAME",
        " side require loss scenario reward-rule level dtype learner budget readout algorithm critic references title "
        "decay only model income fitness return-token "},
};

constexpr std::string_view scenarios = "simple_tag simple_world";
constexpr std::string_view pictures = "svg png pdf";

/// Words that an option takes, of all programs or of one; what each does is in the option's own text.
struct Words {
  std::string_view option;
  std::string_view words;
};

constexpr std::array all_words{
    Words{"model", "ecological integer real encounter moran fermi replicator birth-death pairwise"},
    Words{"income", "ind com"},
    Words{"fitness", "linear exponential"},
    Words{"plot", pictures},
    Words{"side", "both own theirs"},
    Words{"from", "settled"},
    Words{"require", "nash subgame-perfect self-confirming beliefs"},
    Words{"sct-train_loss", "teacher selfconf rmadt madt"},
    Words{"decay", "yes no"},
    Words{"return-token", "shown hidden"},
    Words{"scenario", scenarios},
    Words{"reward-rule", "program paper"},
    Words{"algorithm", "matd3 maddpg"},
    Words{"critic", "centralised independent"},
    Words{"mpe-train_collect_level", "random medium expert"},
    Words{"level", "random medium-replay medium expert"},
    Words{"dtype", "float32 float64"},
    Words{"learner", "bc ma-bcq omar cql madt rmadt sct"},
    Words{"mpe-train_study_budget", "smoke small paper"},
    Words{"budget", "small paper"},
    Words{"mpe-train_offline_loss", "teacher selfconf composite"},
    Words{"readout", "cat add token"},
    Words{"references", "published measured"},
};

/// The line of a table that is for this option of this program, else the one for the option of all programs, or its
/// end.
template <typename Table, typename IsFor>
auto line_for(const Table& table, const std::string& program, const std::string& option, const IsFor& is_for) {
  std::string own = program + "_" + option;
  std::replace(own.begin(), own.end(), ' ', '_');
  for (const std::string& key : {own, option})
    for (auto line = table.begin(); line != table.end(); ++line)
      if (is_for(*line, key)) return line;
  return table.end();
}

}  // namespace

std::string value_name(const std::string& program, const std::string& option) {
  const auto line = line_for(all_values, program, option, [](const Values& values, const std::string& key) {
    return values.options.find(" " + key + " ") != std::string_view::npos;
  });
  return line == all_values.end() ? "VALUE" : std::string(line->name);
}

std::vector<std::string> value_words(const std::string& program, const std::string& option) {
  const auto line = line_for(all_words, program, option,
                             [](const Words& words, const std::string& key) { return words.option == key; });
  std::vector<std::string> words;
  if (line == all_words.end()) return words;
  std::istringstream text{std::string(line->words)};
  for (std::string word; text >> word;) words.push_back(word);
  return words;
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
