#include "mpe_study_words.h"

#include <fmt/format.h>

namespace folk::tools {
namespace {

template <class Row>
PaperCount count(const std::vector<Row>& rows) {
  PaperCount counted;
  for (const auto& row : rows) {
    const auto lies = mpe::to_paper(row);
    if (!lies) continue;
    ++counted.compared;
    if (*lies == mpe::ToPaper::above) ++counted.above;
    if (*lies == mpe::ToPaper::below) ++counted.below;
  }
  return counted;
}

bool papers(const mpe::StudyTables& tables) { return tables.data_prey == "released"; }

}  // namespace

std::vector<Legend> score_legend(const mpe::StudyTables& tables) {
  std::vector<Legend> legend{
      {"score",
       std::string("100 (S - S_random) / (S_expert - S_random), S the undiscounted return of one predator in "
                   "25 steps; ") +
           (papers(tables) ? "S_expert and S_random are the published 185.6 and -4.1 in simple_tag, 79.5 and "
                             "-6.8 in simple_world, whatever the prey"
                           : "S_expert and S_random are measured: MATD3 trained against this prey, and random "
                             "play, both against it. They are taken as exact: that MATD3 has 100 there and random "
                             "play 0 is so by definition")},
      {"± a (n)",
       "half of the 95 % interval, over n training seeds; of several it is Student's over their means, though no "
       "narrower than the episodes alone leave open; of one it is that of the episodes and says nothing of other "
       "trainings"},
      {"not run", "no training of this cell is done yet"},
      {"transformers",
       "MADT, RMADT and SCT are asked for the return that earned most against the same prey on other episodes; the "
       "page and scores.csv also have what they earn when asked for what earned most against the data's prey (data's "
       "target)"},
      {"preys",
       std::string("released: the published program's trained prey") +
           (papers(tables) ? ", which played in the data" : "") + "; maddpg: one that learned longer" +
           (papers(tables) ? "" : ", which played in this data") +
           "; still: never moves; random: the published program's random play; blend 0.5: in each step released or "
           "random by a fair coin"},
      {"players",
       "MATD3 made the data; the pursuit rule runs to where the prey will be; random play is uniform. They "
       "learn nothing here"}};
  if (papers(tables)) {
    legend.push_back({"paper",
                      "arXiv 2310.04579v2, mean over 100 runs. Its two lines of SCT against the blend have the same "
                      "digits in both scenarios, so that one of them is probably a copy"});
    legend.push_back({"*",
                      "further from the paper's number than both 95 % intervals reach; the paper's is taken as "
                      "0.198 of its standard deviation, as of 100 runs"});
  }
  return legend;
}

std::vector<Legend> accuracy_legend(const mpe::StudyTables& tables) {
  std::vector<Legend> legend{
      {"accuracy",
       "share of steps in which the belief b about the prey's action a has |b - a| < 0.1 max(|a|, 0.1). The "
       "paper prints |b - a| < 0.1 |a|, which no belief about a still prey could meet; the page and accuracy.csv also "
       "have the shares at 5, 20 and 50 % instead of 10 %"}};
  if (papers(tables))
    legend.push_back({"*",
                      "further from the paper's number than our 95 % interval reaches; it prints no spread of its "
                      "own"});
  return legend;
}

std::vector<Legend> blend_legend() {
  return {{"p",
           "how likely the prey plays as the released one in a step; else it plays at random. Scores are as above, "
           "transformers asked for what is best against each prey"}};
}

std::vector<Legend> forced_legend() {
  return {{"its own",
           "the score on the belief that the transformer forms; the other columns are differences from it, "
           "over the same episodes, when the belief is replaced"},
          {"the truth", "by what the prey will do in this step"},
          {"of another episode", "by what the prey will do in this step of another episode"},
          {"no action", "by (0, 0)"},
          {"moves", "how far the predators' actions move, mean Euclidean distance; actions lie in [-1, 1] x [-1, 1]"}};
}

std::vector<Legend> asked_legend() {
  return {{"asked",
           "the return that the transformer is asked for, that of one predator in an episode; scores are of "
           "the episodes on which targets are chosen, not of those that are reported above"}};
}

std::string data_title(const mpe::StudyTables& tables) {
  return papers(tables)
             ? "Data with the released prey, as in the paper"
             : fmt::format("Data of predators trained against the prey {}, which learned longer", tables.data_prey);
}

PaperCount score_count(const mpe::StudyTables& tables) { return count(tables.scores); }

PaperCount accuracy_count(const mpe::StudyTables& tables) { return count(tables.accuracies); }

std::string count_words(const PaperCount& count, const std::string& what) {
  return fmt::format(
      "of {} {} that the paper has too, {} {} above and {} below its number, further than the intervals reach",
      count.compared, what, count.above, count.above == 1 ? "is" : "are", count.below);
}

}  // namespace folk::tools
