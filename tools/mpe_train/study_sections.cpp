#include <folk/tools/mpe_train/study_sections.h>

#include <fmt/format.h>
#include <folk/mpe/study/study_blocks.h>
#include <folk/mpe/study/study_pictures.h>

#include <algorithm>
#include <optional>
#include <vector>

namespace folk::tools {
namespace {

using mpe::AccuracyRow;
using mpe::Cell;
using mpe::fixed;
using mpe::ScoreRow;
using mpe::StudyBlock;
using mpe::StudyTables;
using mpe::ToPaper;

Html small(const std::string& text) { return element_of("small", "beside", text); }
Html nothing_run() { return element_of("span", "none", "not run"); }

Html cell_html(const std::optional<Cell>& cell, int decimals) {
  if (!cell) return nothing_run();
  return Html(fmt::format("{} ± {} ", fixed(cell->mean, decimals), fixed(cell->ci95, decimals))) +
         element("small", fmt::format("({})", cell->seeds));
}

/// With a sign beside the colour where it lies apart from the paper's.
Html marked(const Html& cell, const std::optional<ToPaper>& lies) {
  if (!lies || *lies == ToPaper::alike) return cell;
  const bool above = *lies == ToPaper::above;
  return element_of("span", above ? "above" : "below", cell + (above ? " ▲" : " ▼"));
}

Html score_cell(const ScoreRow& row) {
  Html html = marked(cell_html(row.score, 1), mpe::to_paper(row));
  if (row.paper) html += small(fmt::format("paper {} ± {}", fixed(*row.paper, 1), fixed(row.paper_sd.value_or(0), 1)));
  const auto add = [&](const char* target, const std::optional<Cell>& cell) {
    if (row.score && cell && cell->mean != row.score->mean)
      html += small(fmt::format("{} {} ± {}", target, fixed(cell->mean, 1), fixed(cell->ci95, 1)));
  };
  add("data's target", row.at_data_target);
  add("own target", row.at_own_target);
  return html;
}

Html accuracy_cell(const AccuracyRow& row) {
  Html html = cell_html(row.accuracy, 3);
  if (const auto within = mpe::within_inferred(row))
    html += small(fmt::format("within 0.6: {} ± {}", fixed(within->mean, 3), fixed(within->ci95, 3)));
  if (row.paper) html += small(fmt::format("paper {}", fixed(*row.paper, 3)));
  if (!row.accuracy || row.right.size() != mpe::belief_radii.size()) return html;
  std::string radii, shares;
  for (std::size_t r = 0; r < row.right.size(); ++r) {
    if (r == mpe::paper_radius || !row.right[r]) continue;
    radii += fmt::format("{}{:g}", radii.empty() ? "" : "/", 100 * mpe::belief_radii[r]);
    shares += " " + fixed(row.right[r]->mean, 2);
  }
  if (!radii.empty()) html += small(radii + " %:" + shares);
  return html;
}

Html forced_cell(const mpe::ForcedRow& row) {
  if (row.forcing == to_string(mpe::BeliefForcing::none)) return cell_html(row.score, 1);
  Html html = cell_html(row.difference, 1);
  if (row.change) html += small(fmt::format("moves {}", fixed(row.change->mean, 3)));
  return html;
}

/// A block as a table under the words of its level; `title` gives a column's heading, `cell` its cells.
template <class Row, class Title, class CellOf>
Html block_table(const StudyBlock<Row>& block, bool with_prey, Title&& title, CellOf&& cell) {
  std::vector<std::string> headings{"learner"};
  std::vector<std::string> classes{"name"};
  if (with_prey) {
    headings.emplace_back("prey");
    classes.emplace_back("name");
  }
  for (const auto& column : block.columns) {
    headings.push_back(title(column));
    classes.emplace_back("number");
  }
  HtmlTable table(headings, classes);
  for (const auto& line : block.lines) {
    const auto comma = line.learner.find(", ");
    std::vector<Html> row{mpe::learner_title(line.learner.substr(0, with_prey ? comma : std::string::npos))};
    if (with_prey) row.emplace_back(mpe::prey_title(line.learner.substr(comma + 2)));
    for (const Row* one : line.cells) row.push_back(one == nullptr ? Html("-") : Html(cell(*one)));
    table.add(row);
  }
  return table.html();
}

Html legend_list(const std::vector<Legend>& legend) {
  Html list;
  for (const auto& [word, meaning] : legend)
    list += element("dt", word == "*" ? "▲ ▼" : word) + element("dd", meaning + ".");
  return element_of("dl", "legend", list) + "\n";
}

/// Any bytes as a part of a URI.
std::string percent_encoded(const std::string& bytes) {
  constexpr std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_.~,;:/=()!*@";
  std::string text;
  for (const char c : bytes)
    text += plain.find(c) != std::string_view::npos ? std::string(1, c)
                                                    : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  return text;
}

/// The pictures of a kind ("blend"), one a scenario, side by side.
Html pictures_of(const std::string& kind, const StudyTables& tables, const DrawnPictures& pictures) {
  Html row;
  for (const auto& picture : mpe::study_pictures(tables)) {
    if (!picture.name.starts_with(mpe::file_prefix(tables) + kind + "_")) continue;
    const auto found = pictures.svgs.find(picture.name);
    if (found == pictures.svgs.end()) continue;
    // An image of its own: the names inside one picture mean nothing in another, and nothing in it can run.
    row += element("figure", Html::markup(fmt::format("<img src=\"data:image/svg+xml,{}\" alt=\"{}\">",
                                                      percent_encoded(found->second), Html(picture.words).string()))) +
           "\n";
  }
  return row.empty() ? row : element_of("div", "row", Html("\n") + row) + "\n";
}

template <class Row>
bool any_begun(const std::vector<StudyBlock<Row>>& blocks) {
  return std::any_of(blocks.begin(), blocks.end(), [](const auto& block) { return block.begun(); });
}

/// All blocks of a kind, each under its scenario and level; those that are not begun are named in one line.
template <class Row, class Title, class CellOf>
Html blocks_html(const std::vector<StudyBlock<Row>>& blocks, bool with_prey, Title&& title, CellOf&& cell) {
  Html html;
  std::string left;
  for (const auto& block : blocks) {
    const std::string name = fmt::format("{}, {} data", block.scenario, block.level);
    if (block.begun())
      html += heading(4, name) + block_table(block, with_prey, title, cell);
    else
      left += (left.empty() ? "" : "; ") + name;
  }
  if (!left.empty()) html += paragraph(element_of("span", "none", "Not run: " + left + "."));
  return html;
}

Html details(const std::string& summary, const Html& content) {
  return element("details", element("summary", summary) + "\n" + content) + "\n";
}

std::size_t planned_seeds(const mpe::StudySettings& settings, const StudyTables& tables, const mpe::StudyPlace& place) {
  const auto jobs = mpe::study_jobs(settings);
  return static_cast<std::size_t>(std::count_if(jobs.begin(), jobs.end(), [&](const mpe::StudyJob& job) {
    return job.data_prey == tables.data_prey && job.scenario == place.scenario && job.level == place.level &&
           job.learner == place.learner;
  }));
}

std::string level_title(const std::string& level) { return level == "none" ? "no data" : level + " data"; }

}  // namespace

Html progress_table(const StudyTables& tables, const mpe::StudySettings& settings) {
  const auto places = mpe::study_places(tables);
  std::vector<std::string> learners;
  for (const auto* words : {&mpe::study_learners(), &mpe::study_players()})
    for (const auto& learner : *words)
      if (std::any_of(places.begin(), places.end(), [&](const auto& place) { return place.learner == learner; }))
        learners.push_back(learner);
  std::vector<std::string> headings{"data"};
  for (const auto& learner : learners) headings.push_back(mpe::learner_title(learner));
  HtmlTable table(headings, {"name"});
  for (const auto& scenario : mpe::study_scenarios())
    for (const char* level : {"expert", "medium", "random", "none"}) {
      std::vector<Html> row{fmt::format("{}, {}", scenario, level_title(level))};
      bool any = false;
      for (const auto& learner : learners) {
        const auto found = std::find_if(places.begin(), places.end(), [&](const auto& place) {
          return place.scenario == scenario && place.level == level && place.learner == learner;
        });
        if (found == places.end()) {
          row.emplace_back("");
          continue;
        }
        any = true;
        const std::size_t planned = planned_seeds(settings, tables, *found);
        row.push_back(element_of("span", found->seeds < planned ? "none" : "done",
                                 fmt::format("{} of {}", found->seeds, planned)));
      }
      if (any) table.add(row);
    }
  return table.html();
}

std::string progress_words(const StudyTables& main, const StudyTables& second, const mpe::StudySettings& settings) {
  std::size_t done = 0, planned = 0;
  for (const auto* tables : {&main, &second})
    for (const auto& place : mpe::study_places(*tables)) {
      done += place.seeds;
      planned += planned_seeds(settings, *tables, place);
    }
  return fmt::format("{} of {} jobs are done", done, planned);
}

Html data_section(const StudyTables& tables, const DrawnPictures& pictures) {
  Html html = heading(2, data_title(tables));
  for (const auto& line : tables.diverged) html += paragraph("Diverged: " + line);
  const auto scores = mpe::score_blocks(tables);
  if (!any_begun(scores)) return html + paragraph(nothing_run());
  const auto same = [](const std::string& column) { return column; };
  html += heading(3, "Scores");
  if (const auto count = score_count(tables); count.compared > 0)
    html += paragraph("Agreement: " + count_words(count) + ".");
  html += pictures_of("scores", tables, pictures) + blocks_html(scores, false, mpe::prey_title, score_cell) +
          legend_list(score_legend(tables));
  if (const auto paired = mpe::paired_blocks(tables); any_begun(paired))
    html += heading(3, "Differences of scores") +
            blocks_html(paired, false, mpe::prey_title,
                        [](const mpe::PairedRow& row) { return cell_html(row.difference, 1); }) +
            legend_list(paired_legend());
  if (const auto accuracies = mpe::accuracy_blocks(tables); any_begun(accuracies)) {
    html += heading(3, "Accuracy of beliefs");
    html += pictures_of("accuracy", tables, pictures) + blocks_html(accuracies, false, mpe::prey_title, accuracy_cell) +
            legend_list(accuracy_legend(tables));
  }
  const auto score = [](const auto& row) { return cell_html(row.score, 1); };
  html += heading(3, "Blends") + pictures_of("blend", tables, pictures) +
          blocks_html(
              mpe::blend_blocks(tables), false, [](const std::string& p) { return "p = " + p; }, score) +
          legend_list(blend_legend());
  if (const auto forced = mpe::forced_blocks(tables); any_begun(forced))
    html += heading(3, "Forced beliefs") + legend_list(forced_legend()) +
            details("The tables", blocks_html(forced, true, mpe::forcing_title, forced_cell));
  if (const auto asked = mpe::asked_blocks(tables); any_begun(asked))
    html += heading(3, "Asked returns") + pictures_of("asked", tables, pictures) + legend_list(asked_legend()) +
            details("The tables", blocks_html(asked, true, same, score));
  return html;
}

}  // namespace folk::tools
