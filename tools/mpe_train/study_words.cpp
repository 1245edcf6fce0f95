#include <folk/tools/mpe_train/study_words.h>

#include <fmt/format.h>

namespace folk::tools {
namespace {

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
      {"not run", "no training of this cell is done yet, or each of them diverged and is named above"},
      {"transformers",
       "MADT, RMADT and SCT are asked for the return that earned most against the same prey on other episodes; the "
       "page and scores.csv also have what they earn when asked for what earned most against the data's prey (data's "
       "target), and for the mean return of the data, which no episode is needed to choose (own target)"},
      {"data", "data sets are free of noise: predators and prey play deterministically in them"},
      {"preys",
       std::string("released: the published program's trained prey") +
           (papers(tables) ? ", which played in the data and which the paper calls MATD3" : "") +
           "; maddpg: one that learned longer" +
           (papers(tables) ? ". The paper's prey of that name is another one, whose weights do not exist: its numbers "
                             "are printed, but nothing is held against them"
                           : ", which played in this data") +
           "; still: never moves; random: the published program's random play; blend 0.5: in each step released or "
           "random by a fair coin"},
      {"players",
       "MATD3 made the data; the pursuit rule runs to where the prey will be; random play is uniform. They "
       "learn nothing here"},
      {"MA-BCQ", "at budget small it is little more than a clone of the data"}};
  if (papers(tables)) {
    legend.push_back({"expert",
                      "ours, who made the expert data, earns 260 in simple_tag where the field's earned 185.6, so that "
                      "a perfect clone of the data scores about 139; in simple_world, likewise, about 161"});
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
       "share of steps in which the belief b about the prey's action a has |b - a| < 0.1 max(|a|, 0.1); the page "
       "and accuracy.csv also have the shares at 5, 20 and 50 % instead of 10 %"},
      {"within 0.6", "share of steps with |b - a| < 0.6, whatever a is; accuracy.csv also has 0.1 and 0.3"}};
  if (papers(tables))
    legend.push_back(
        {"paper",
         "the paper prints a relative error of 10 %, from which its numbers cannot come: a random action cannot be "
         "foreseen within 10 % in 30 % of the steps; an absolute radius of 0.6 explains them, which is our inference"});
  return legend;
}

std::vector<Legend> paired_legend() {
  return {{"SCT minus",
           "the score of SCT less that of another learner trained with the same seed, over the same episodes: their "
           "means over 16 parts of the episodes are subtracted one by one, so that what both owe to the episodes falls "
           "out. ± is Student's interval over the parts; of several seeds it is Student's over these, though no "
           "narrower than the parts alone leave open. Transformers are asked for what is best against each prey"}};
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
          {"SCT, paper's loss", "its forced beliefs also stay in the slots of past steps"},
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

PaperCount score_count(const mpe::StudyTables& tables) {
  PaperCount counted;
  for (const auto& row : tables.scores) {
    const auto lies = mpe::to_paper(row);
    if (!lies) continue;
    ++counted.compared;
    if (*lies == mpe::ToPaper::above) ++counted.above;
    if (*lies == mpe::ToPaper::below) ++counted.below;
  }
  return counted;
}

std::string count_words(const PaperCount& count) {
  return fmt::format(
      "of {} scores that the paper has too, {} {} above and {} below its number, further than the intervals reach",
      count.compared, count.above, count.above == 1 ? "is" : "are", count.below);
}

}  // namespace folk::tools
