#include <folk/tools/mpe_train/study_text.h>

#include <folk/tools/mpe_train/study_words.h>
#include <folk/tools/program/table.h>

#include <fmt/format.h>
#include <folk/mpe/study/study_blocks.h>

#include <algorithm>
#include <optional>
#include <vector>

namespace folk::tools {
namespace {

using mpe::Cell;
using mpe::fixed;
using mpe::ScoreRow;
using mpe::StudyBlock;
using mpe::StudyTables;

constexpr const char* not_run = "not run";

/// "103.2 ± 8.3 (3)", its mean right-aligned among others of its column.
std::string cell_text(const std::optional<Cell>& cell, int decimals) {
  if (!cell) return not_run;
  return fmt::format("{:>6} ± {:>{}} ({})", fixed(cell->mean, decimals), fixed(cell->ci95, decimals),
                     decimals == 1 ? 4 : 5, cell->seeds);
}

std::string marked(const ScoreRow& row, std::string text) {
  const auto lies = mpe::to_paper(row);
  return lies && *lies != mpe::ToPaper::alike ? text + " *" : text;
}

std::string paper_text(const std::optional<double>& paper, int decimals) {
  return paper ? fixed(*paper, decimals) : "-";
}

std::string legend_text(const std::vector<Legend>& legend) {
  constexpr std::size_t width = 118;
  std::string text;
  for (const auto& [word, meaning] : legend) {
    std::string line = word + ": ";
    std::string rest = meaning + ".";
    while (!rest.empty()) {
      const std::size_t end = std::min(rest.find(' '), rest.size());
      if (line.size() + end > width) {
        text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
        line = "  ";
      }
      line += rest.substr(0, end) + " ";
      rest.erase(0, end + 1);
    }
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return text + "\n";
}

std::string block_heading(const std::string& kind, const std::string& scenario, const std::string& level) {
  return fmt::format("{}: {}, {} data\n", kind, scenario, level);
}

/// Blocks of some columns a prey, the paper's numbers in the last of them where it has any.
template <class Row, class Cells>
std::string paper_blocks(const std::vector<StudyBlock<Row>>& blocks, const std::string& kind,
                         const std::vector<std::string>& more, int decimals, Cells&& cells) {
  std::string text;
  for (const auto& block : blocks) {
    text += block_heading(kind, block.scenario, block.level);
    if (!block.begun()) {
      text += fmt::format("{}\n\n", not_run);
      continue;
    }
    bool papers = false;
    for (const auto& line : block.lines)
      for (const Row* row : line.cells) papers = papers || (row != nullptr && row->paper);
    std::vector<std::string> header{"learner"};
    for (const auto& prey : block.columns) {
      header.push_back(mpe::prey_title(prey));
      header.insert(header.end(), more.begin(), more.end());
      if (papers) header.emplace_back("paper");
    }
    Table table(header);
    for (const auto& line : block.lines) {
      std::vector<std::string> row{mpe::learner_title(line.learner)};
      for (const Row* one : line.cells) {
        for (const auto& field : one == nullptr ? std::vector<std::string>(1 + more.size(), "-") : cells(*one))
          row.push_back(field);
        if (papers) row.push_back(one == nullptr ? "-" : paper_text(one->paper, decimals));
      }
      table.add(row);
    }
    text += table.text() + "\n";
  }
  return text;
}

std::string scores_text(const std::vector<StudyBlock<ScoreRow>>& blocks) {
  return paper_blocks(blocks, "Scores", {}, 1, [](const ScoreRow& row) {
    return std::vector<std::string>{marked(row, cell_text(row.score, 1))};
  });
}

std::string accuracies_text(const std::vector<StudyBlock<mpe::AccuracyRow>>& blocks) {
  return paper_blocks(blocks, "Accuracy of beliefs", {"within 0.6"}, 3, [](const mpe::AccuracyRow& row) {
    const auto within = mpe::within_inferred(row);
    return std::vector<std::string>{cell_text(row.accuracy, 3), within ? fixed(within->mean, 3) : "-"};
  });
}

std::string paired_text(const StudyTables& tables) {
  std::string text;
  for (const auto& block : mpe::paired_blocks(tables)) {
    if (!block.begun()) continue;
    text += block_heading("Differences of scores", block.scenario, block.level);
    std::vector<std::string> header{"difference"};
    for (const auto& prey : block.columns) header.push_back(mpe::prey_title(prey));
    Table table(header);
    for (const auto& line : block.lines) {
      std::vector<std::string> row{line.learner};
      for (const auto* one : line.cells) row.push_back(one == nullptr ? "-" : cell_text(one->difference, 1));
      table.add(row);
    }
    text += table.text() + "\n";
  }
  return text.empty() ? text : text + legend_text(paired_legend());
}

std::string blend_text(const StudyTables& tables) {
  std::string text;
  for (const auto& block : mpe::blend_blocks(tables)) {
    if (!block.begun()) continue;
    text += block_heading("Blends", block.scenario, block.level);
    std::vector<std::string> header{"learner"};
    for (const auto& p : block.columns) header.push_back("p = " + p);
    Table table(header);
    for (const auto& line : block.lines) {
      std::vector<std::string> row{mpe::learner_title(line.learner)};
      for (const auto* one : line.cells) row.push_back(one == nullptr ? "-" : cell_text(one->score, 1));
      table.add(row);
    }
    text += table.text() + "\n";
  }
  return text.empty() ? text : text + legend_text(blend_legend());
}

/// "sct, still" as two fields.
std::vector<std::string> learner_and_prey(const std::string& line) {
  const auto comma = line.find(", ");
  return {mpe::learner_title(line.substr(0, comma)), mpe::prey_title(line.substr(comma + 2))};
}

std::string forced_text(const StudyTables& tables) {
  std::string text;
  for (const auto& block : mpe::forced_blocks(tables)) {
    if (!block.begun()) continue;
    text += block_heading("Forced beliefs", block.scenario, block.level);
    std::vector<std::string> header{"learner", "prey"};
    for (const auto& forcing : block.columns) {
      header.push_back(mpe::forcing_title(forcing));
      if (forcing != to_string(mpe::BeliefForcing::none)) header.emplace_back("moves");
    }
    Table table(header);
    for (const auto& line : block.lines) {
      std::vector<std::string> row = learner_and_prey(line.learner);
      for (std::size_t c = 0; c < line.cells.size(); ++c) {
        const auto* one = line.cells[c];
        const bool own = block.columns[c] == to_string(mpe::BeliefForcing::none);
        row.push_back(one == nullptr ? "-" : cell_text(own ? one->score : one->difference, 1));
        if (!own) row.push_back(one == nullptr || !one->change ? "-" : fixed(one->change->mean, 3));
      }
      table.add(row);
    }
    text += table.text() + "\n";
  }
  return text.empty() ? text : text + legend_text(forced_legend());
}

/// Against the data's prey alone: returns_asked.csv and the page have the others.
std::string asked_text(const StudyTables& tables) {
  std::string text;
  for (const auto& block : mpe::asked_blocks(tables)) {
    if (!block.begun()) continue;
    text += block_heading("Asked returns against " + tables.data_prey, block.scenario, block.level);
    std::vector<std::string> header{"learner"};
    for (const auto& target : block.columns) header.push_back("asked " + target);
    Table table(header);
    for (const auto& line : block.lines) {
      if (!line.learner.ends_with(", " + tables.data_prey)) continue;
      std::vector<std::string> row{learner_and_prey(line.learner).front()};
      for (const auto* one : line.cells) row.push_back(one == nullptr ? "-" : cell_text(one->score, 1));
      table.add(row);
    }
    text += table.text() + "\n";
  }
  return text.empty() ? text : text + legend_text(asked_legend());
}

std::string tables_text(const StudyTables& tables) {
  const std::string title = data_title(tables);
  std::string text = title + "\n" + std::string(title.size(), '=') + "\n\n";
  for (const auto& line : tables.diverged) text += "Diverged: " + line + "\n";
  if (!tables.diverged.empty()) text += "\n";
  const auto scores = mpe::score_blocks(tables);
  if (std::none_of(scores.begin(), scores.end(), [](const auto& block) { return block.begun(); }))
    return text + not_run + "\n\n";
  text += scores_text(scores);
  if (const auto count = score_count(tables); count.compared > 0) text += count_words(count) + "\n";
  text += legend_text(score_legend(tables)) + paired_text(tables);
  const auto accuracies = mpe::accuracy_blocks(tables);
  if (std::any_of(accuracies.begin(), accuracies.end(), [](const auto& block) { return block.begun(); })) {
    text += accuracies_text(accuracies) + legend_text(accuracy_legend(tables));
  }
  return text + blend_text(tables) + forced_text(tables) + asked_text(tables);
}

}  // namespace

std::string study_text(const StudyTables& main, const StudyTables& second) {
  std::string text = fmt::format("Study of the particle world, budget {}\n\n", main.budget);
  text += tables_text(main) + tables_text(second);
  text.pop_back();  // the blank line at the end
  return text;
}

}  // namespace folk::tools
