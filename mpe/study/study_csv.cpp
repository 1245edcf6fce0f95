#include <folk/mpe/study/study_blocks.h>
#include <folk/mpe/study/study_csv.h>
#include <folk/mpe/study/study_words.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <optional>

namespace folk::mpe {
namespace {

constexpr int score_decimals = 4;
constexpr int share_decimals = 6;

using Fields = std::vector<std::string>;

/// Lines under a header.
class Csv {
public:
  Csv(const StudyTables& tables, const char* header)
      : budget_(tables.budget),
        text_(std::string(header) + "\n") {}

  /// A row: whose it is, its cell, the seeds and the budget, what follows.
  void add(Fields fields, const std::optional<Cell>& cell, int decimals, const Fields& more = {}) {
    append(fields, cell, decimals);
    fields.push_back(fmt::to_string(cell ? cell->seeds : 0));
    fields.push_back(budget_);
    fields.insert(fields.end(), more.begin(), more.end());
    text_ += fmt::format("{}\n", fmt::join(fields, ","));
  }

  /// A cell's mean and interval.
  static void append(Fields& fields, const std::optional<Cell>& cell, int decimals) {
    fields.push_back(cell ? fixed(cell->mean, decimals) : "");
    fields.push_back(cell ? fixed(cell->ci95, decimals) : "");
  }

  std::string take() && { return std::move(text_); }

private:
  std::string budget_;
  std::string text_;
};

std::string mean_text(const std::optional<Cell>& cell) { return cell ? fixed(cell->mean, share_decimals) : ""; }

/// A number of the paper with the digits that it prints.
std::string paper_text(const std::optional<double>& value) { return value ? fmt::format("{}", *value) : ""; }

std::string word(const std::optional<ToPaper>& to_paper) {
  if (!to_paper) return "";
  switch (*to_paper) {
    case ToPaper::alike: return "alike";
    case ToPaper::above: return "above";
    case ToPaper::below: break;
  }
  return "below";
}

}  // namespace

std::string scores_csv(const StudyTables& tables) {
  Csv csv(tables,
          "scenario,level,learner,prey,score,ci95,seeds,budget,at_data_target,at_data_target_ci95,at_own_target,"
          "at_own_target_ci95,paper,paper_sd,to_paper");
  for (const auto& row : tables.scores) {
    Fields more;
    Csv::append(more, row.at_data_target, score_decimals);
    Csv::append(more, row.at_own_target, score_decimals);
    more.insert(more.end(), {paper_text(row.paper), paper_text(row.paper_sd), word(to_paper(row))});
    csv.add({row.scenario, row.level, row.learner, row.prey}, row.score, score_decimals, more);
  }
  return std::move(csv).take();
}

std::string paired_csv(const StudyTables& tables) {
  Csv csv(tables, "scenario,level,prey,minus,difference,ci95,seeds,budget");
  for (const auto& row : tables.paired)
    csv.add({row.scenario, row.level, row.prey, row.learner}, row.difference, score_decimals);
  return std::move(csv).take();
}

std::string players_csv(const StudyTables& tables) {
  Csv csv(tables, "scenario,level,learner,prey,score,ci95,seeds,budget");
  for (const auto& row : tables.players)
    csv.add({row.scenario, row.level, row.learner, row.prey}, row.score, score_decimals);
  return std::move(csv).take();
}

std::string accuracy_csv(const StudyTables& tables) {
  // The columns' names hold the radii; the one that is missing is the accuracy itself.
  static_assert(belief_radii == std::array{0.05, 0.1, 0.2, 0.5} && paper_radius == 1);
  Csv csv(tables,
          "scenario,level,learner,prey,accuracy,ci95,seeds,budget,within_5,within_20,within_50,within_0.1,within_0.3,"
          "within_0.6,distance,paper");
  for (const auto& row : tables.accuracies) {
    const auto right = [&](std::size_t r) { return r < row.right.size() ? mean_text(row.right[r]) : std::string(); };
    const auto within = [&](std::size_t r) { return r < row.within.size() ? mean_text(row.within[r]) : std::string(); };
    csv.add({row.scenario, row.level, row.learner, row.prey}, row.accuracy, share_decimals,
            {right(0), right(2), right(3), within(0), within(1), within(2), mean_text(row.distance),
             paper_text(row.paper)});
  }
  return std::move(csv).take();
}

std::string blend_csv(const StudyTables& tables) {
  Csv csv(tables, "scenario,level,learner,p,score,ci95,seeds,budget");
  for (const auto& row : tables.blends)
    csv.add({row.scenario, row.level, row.learner, fmt::format("{}", row.p)}, row.score, score_decimals);
  return std::move(csv).take();
}

std::string beliefs_forced_csv(const StudyTables& tables) {
  Csv csv(tables,
          "scenario,level,learner,prey,belief,score,ci95,seeds,budget,difference,difference_ci95,change,change_ci95");
  for (const auto& row : tables.forced) {
    Fields more;
    Csv::append(more, row.difference, score_decimals);
    Csv::append(more, row.change, share_decimals);
    csv.add({row.scenario, row.level, row.learner, row.prey, row.forcing}, row.score, score_decimals, more);
  }
  return std::move(csv).take();
}

std::string returns_asked_csv(const StudyTables& tables) {
  Csv csv(tables, "scenario,level,learner,prey,asked,score,ci95,seeds,budget,accuracy,accuracy_ci95");
  for (const auto& row : tables.asked) {
    Fields more;
    Csv::append(more, row.accuracy, share_decimals);
    csv.add({row.scenario, row.level, row.learner, row.prey, fmt::format("{}", row.target)}, row.score, score_decimals,
            more);
  }
  return std::move(csv).take();
}

std::string returns_csv(const StudyTables& tables) {
  Csv csv(tables, "scenario,level,learner,return,ci95,seeds,budget,data_return");
  for (const auto& place : study_places(tables)) {
    std::optional<Cell> cell;
    const std::string data = fmt::format("{}-{}", place.scenario, place.level);
    const auto found = tables.data_prey_returns.find(data + "-" + place.learner);
    if (found != tables.data_prey_returns.end()) cell = found->second;
    const auto of_data = tables.data_returns.find(data);
    csv.add({place.scenario, place.level, place.learner}, cell, score_decimals,
            {of_data == tables.data_returns.end() ? "" : fixed(of_data->second, score_decimals)});
  }
  return std::move(csv).take();
}

std::vector<NamedText> study_csv_files(const StudyTables& tables) {
  const std::string prefix = file_prefix(tables);
  return {{prefix + "scores.csv", scores_csv(tables)},
          {prefix + "paired.csv", paired_csv(tables)},
          {prefix + "players.csv", players_csv(tables)},
          {prefix + "accuracy.csv", accuracy_csv(tables)},
          {prefix + "blend.csv", blend_csv(tables)},
          {prefix + "beliefs_forced.csv", beliefs_forced_csv(tables)},
          {prefix + "returns_asked.csv", returns_asked_csv(tables)},
          {prefix + "returns.csv", returns_csv(tables)}};
}

}  // namespace folk::mpe
