#include <folk/mpe/study/study_blocks.h>
#include <folk/mpe/study/study_latex.h>
#include <folk/mpe/study/study_words.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <utility>

namespace folk::mpe {
namespace {

constexpr const char* not_run = "--";

std::string number(double mean, double half, int decimals) {
  return fmt::format("${} \\pm {}$", fixed(mean, decimals), fixed(half, decimals));
}

std::string number(const std::optional<Cell>& cell, int decimals, const std::optional<ToPaper>& to_paper) {
  if (!cell) return not_run;
  const std::string text = number(cell->mean, cell->ci95, decimals);
  return to_paper.value_or(ToPaper::alike) == ToPaper::alike ? text : text + "\\rlap{$^{*}$}";
}

/// How the rows of one kind of table are written.
template <class Row>
struct Style {
  std::string label;    ///< "scores"
  std::string caption;  ///< what is said of the numbers
  std::function<std::string(const std::string&)> heading;
  std::function<std::string(const Row&)> cell;
  /// Lines below a learner's and what they are called; empty where there is nothing to say of a row.
  std::vector<std::pair<std::string, std::function<std::string(const Row&)>>> below = {};
};

template <class Row>
std::size_t seeds_of(const typename StudyBlock<Row>::Line& line) {
  std::size_t seeds = 0;
  for (const Row* row : line.cells) {
    if (row == nullptr) continue;
    if constexpr (requires { row->score; })
      seeds = std::max(seeds, row->score ? row->score->seeds : 0);
    else
      seeds = std::max(seeds, row->accuracy ? row->accuracy->seeds : 0);
  }
  return seeds;
}

template <class Row>
std::string lines_of(const StudyBlock<Row>& block, const Style<Row>& style) {
  std::string text;
  for (const auto& line : block.lines) {
    text += latex_text(learner_title(line.learner));
    for (const Row* row : line.cells)
      text += fmt::format(" & {}", row == nullptr ? std::string(not_run) : style.cell(*row));
    text += fmt::format(" & {} \\\\\n", seeds_of<Row>(line));
    for (const auto& [name, words] : style.below) {
      std::vector<std::string> cells;
      for (const Row* row : line.cells) cells.push_back(row != nullptr ? words(*row) : "");
      if (std::all_of(cells.begin(), cells.end(), [](const std::string& one) { return one.empty(); })) continue;
      text += fmt::format("\\quad\\emph{{{}}} & {} & \\\\\n", name, fmt::join(cells, " & "));
    }
  }
  return text;
}

/// All blocks of a scenario as one table.
template <class Row>
std::string tables_of(const StudyTables& tables, const std::vector<StudyBlock<Row>>& blocks, const Style<Row>& style) {
  std::string text = "% A part of a document with \\usepackage{booktabs}.\n";
  for (std::size_t first = 0; first < blocks.size();) {
    const std::string& scenario = blocks[first].scenario;
    const auto& columns = blocks[first].columns;
    text += fmt::format(
        "\\begin{{table}}[p]\n\\centering\n\\caption{{{}: {} Budget {}.{}}}\n", latex_text(scenario), style.caption,
        latex_text(tables.budget),
        tables.data_prey == "released" ? std::string() : " Data with the prey " + latex_text(tables.data_prey) + ".");
    text += fmt::format("\\label{{tab:{}{}-{}}}\n\\footnotesize\n\\setlength{{\\tabcolsep}}{{4pt}}\n",
                        tables.data_prey == "released" ? "" : "trained-prey-", style.label,
                        scenario.ends_with("world") ? "world" : "tag");
    text += fmt::format("\\begin{{tabular}}{{l{}r}}\n\\toprule\n", std::string(columns.size(), 'r'));
    for (const auto& column : columns) text += " & " + latex_text(style.heading(column));
    text += " & seeds \\\\\n";
    for (; first < blocks.size() && blocks[first].scenario == scenario; ++first) {
      text += fmt::format("\\midrule\n\\multicolumn{{{}}}{{l}}{{\\emph{{{} data}}}} \\\\\n", columns.size() + 2,
                          latex_text(blocks[first].level));
      text += lines_of(blocks[first], style);
    }
    text += "\\bottomrule\n\\end{tabular}\n\\end{table}\n";
  }
  return text;
}

const char* score_words(const StudyTables& tables) {
  return tables.data_prey == "released"
             ? "normalised score, $100\\,(S - S_{\\mathrm{random}}) / (S_{\\mathrm{expert}} - S_{\\mathrm{random}})$ "
               "with the published references."
             : "normalised score, $100\\,(S - S_{\\mathrm{random}}) / (S_{\\mathrm{expert}} - S_{\\mathrm{random}})$ "
               "with references measured against this prey.";
}

constexpr const char* interval_words =
    " Means over training seeds and their 95\\,\\% intervals; of one seed the interval is that of its episodes.";

constexpr const char* star_words =
    " $^{*}$: further from the paper's number than both 95\\,\\% intervals reach (the paper's prey maddpg is another "
    "one).";

}  // namespace

std::string latex_text(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '\\': out += "\\textbackslash{}"; break;
      case '~': out += "\\textasciitilde{}"; break;
      case '^': out += "\\textasciicircum{}"; break;
      case '<': out += "\\textless{}"; break;
      case '>': out += "\\textgreater{}"; break;
      case '|': out += "\\textbar{}"; break;
      case '"': out += "\\textquotedbl{}"; break;
      case '{':
      case '}':
      case '$':
      case '&':
      case '#':
      case '%':
      case '_':
        out += '\\';
        out += c;
        break;
      default: out += c;
    }
  }
  return out;
}

std::string scores_latex(const StudyTables& tables) {
  const bool papers = tables.data_prey == "released";
  Style<ScoreRow> style;
  style.label = "scores";
  style.caption =
      std::string(score_words(tables)) + interval_words +
      (papers ? std::string(" The paper's lines: mean $\\pm$ standard deviation over 100 runs.") + star_words
              : std::string());
  style.heading = prey_title;
  style.cell = [](const ScoreRow& row) { return number(row.score, 1, to_paper(row)); };
  style.below = {{"paper", [](const ScoreRow& row) {
                    return row.paper && row.paper_sd ? number(*row.paper, *row.paper_sd, 1) : std::string();
                  }}};
  return tables_of(tables, score_blocks(tables), style);
}

std::string accuracy_latex(const StudyTables& tables) {
  Style<AccuracyRow> style;
  style.label = "accuracy";
  style.caption =
      std::string(
          "share of steps whose belief $b$ about the prey's action $a$ has "
          "$|b - a| < 0.1 \\max(|a|, 0.1)$, and below it that of $|b - a| < 0.6$.") +
      interval_words +
      (tables.data_prey == "released" ? " The paper prints a relative error of 10\\,\\%, from which its numbers cannot "
                                        "come; that an absolute radius of 0.6 explains them is our inference."
                                      : "");
  style.heading = prey_title;
  style.cell = [](const AccuracyRow& row) { return number(row.accuracy, 3, std::nullopt); };
  style.below = {{"within 0.6",
                  [](const AccuracyRow& row) {
                    const auto within = within_inferred(row);
                    return within ? number(within, 3, std::nullopt) : std::string();
                  }},
                 {"paper", [](const AccuracyRow& row) {
                    return row.paper ? fmt::format("${}$", fixed(*row.paper, 3)) : std::string();
                  }}};
  return tables_of(tables, accuracy_blocks(tables), style);
}

std::string blend_latex(const StudyTables& tables) {
  Style<BlendRow> style;
  style.label = "blend";
  style.caption = std::string(
                      "score against a prey that plays as the released one with probability $p$ in each step "
                      "and at random otherwise; ") +
                  score_words(tables) + interval_words;
  style.heading = [](const std::string& p) { return "p = " + p; };
  style.cell = [](const BlendRow& row) { return number(row.score, 1, std::nullopt); };
  return tables_of(tables, blend_blocks(tables), style);
}

std::vector<NamedText> study_latex_files(const StudyTables& main, const StudyTables& second) {
  std::vector<NamedText> files;
  std::string document =
      "\\documentclass{article}\n\\usepackage[T1]{fontenc}\n\\usepackage[a4paper,margin=2cm]{geometry}\n"
      "\\usepackage{booktabs}\n\\begin{document}\n";
  for (const auto* tables : {&main, &second}) {
    const std::string prefix = file_prefix(*tables);
    files.push_back({prefix + "scores.tex", scores_latex(*tables)});
    files.push_back({prefix + "accuracy.tex", accuracy_latex(*tables)});
    files.push_back({prefix + "blend.tex", blend_latex(*tables)});
    for (const char* name : {"scores", "accuracy", "blend"}) document += fmt::format("\\input{{{}{}}}\n", prefix, name);
    document += "\\clearpage\n";
  }
  files.push_back({"tables.tex", document + "\\end{document}\n"});
  return files;
}

}  // namespace folk::mpe
