#include <folk/mpe/study/study_latex.h>

#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "games/has.h"
#include "mpe/study/made_up_tables.h"

namespace folk::mpe {
namespace {

using folk::test::has;
using test::made_up_second_tables;
using test::made_up_tables;

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) ++count;
  return count;
}

TEST(StudyLatex, NoByteOfATextIsACommand) {
  EXPECT_EQ(latex_text("a_b & 5% #1 $x$ {y} \\z ~ ^"),
            "a\\_b \\& 5\\% \\#1 \\$x\\$ \\{y\\} \\textbackslash{}z \\textasciitilde{} \\textasciicircum{}");
  EXPECT_EQ(latex_text("<a|\"b\">"), "\\textless{}a\\textbar{}\\textquotedbl{}b\\textquotedbl{}\\textgreater{}");
  EXPECT_EQ(latex_text("plain (0.5), paper's"), "plain (0.5), paper's");
}

TEST(StudyLatex, ScoresStandAboveThePapers) {
  const std::string text = scores_latex(made_up_tables());
  EXPECT_TRUE(has(text,
                  "SCT & $103.2 \\pm 8.2$\\rlap{$^{*}$} & $0.0 \\pm 4.0$ & 3 \\\\\n"
                  "\\quad\\emph{paper} & $121.1 \\pm 8.2$ & $-1.5 \\pm 2.0$ & \\\\\n"))
      << text;
  // No line of the paper where it has none, and dashes for what was not run.
  EXPECT_TRUE(has(text,
                  "MADT & $90.0 \\pm 2.0$ & -- & 1 \\\\\nMATD3 (made the data) & $99.5 \\pm 1.5$ & -- & 1 \\\\\n"
                  "pursuit rule & $123.5 \\pm 1.0$ & -- & 1 \\\\\n"))
      << text;
  EXPECT_TRUE(has(text, "OMAR & -- & 0 \\\\\n\\quad\\emph{paper} & $114.2 \\pm 3.5$ & \\\\\n")) << text;
}

TEST(StudyLatex, AScenarioIsATable) {
  const std::string text = scores_latex(made_up_tables());
  EXPECT_EQ(count_of(text, "\\begin{table}"), 2U);
  EXPECT_EQ(count_of(text, "\\end{table}"), 2U);
  EXPECT_EQ(count_of(text, "\\label{tab:scores-tag}"), 1U);
  EXPECT_EQ(count_of(text, "\\label{tab:scores-world}"), 1U);
  EXPECT_TRUE(has(text, "\\caption{simple\\_tag: ")) << text;
  EXPECT_LT(text.find("tab:scores-tag"), text.find("tab:scores-world"));
  EXPECT_EQ(count_of(text.substr(0, text.find("\\end{table}")), "\\midrule"), 2U);  // expert and random data
}

TEST(StudyLatex, OtherNumbersAreThere) {
  const std::string accuracy = accuracy_latex(made_up_tables());
  EXPECT_TRUE(has(accuracy,
                  "SCT & $0.875 \\pm 0.010$ & 3 \\\\\n\\quad\\emph{within 0.6} & $0.984 \\pm 0.005$ & \\\\\n"
                  "\\quad\\emph{paper} & $1.000$ & \\\\\n"))
      << accuracy;
  EXPECT_FALSE(has(accuracy, "$^{*}$"));
  const std::string blend = blend_latex(made_up_tables());
  EXPECT_TRUE(has(blend, " & p = 1 & p = 0.3 & seeds \\\\\n")) << blend;
  EXPECT_TRUE(has(blend, "SCT & $103.2 \\pm 8.2$ & $40.5 \\pm 2.0$ & 3 \\\\\n")) << blend;
}

/// What TeX would stumble over: every line of a tabular has as many columns as it says, environments are closed.
void expect_sound(const std::string& text) {
  std::istringstream lines(text);
  std::size_t columns = 0;
  std::vector<std::string> open;
  for (std::string line; std::getline(lines, line);) {
    for (const unsigned char c : line) EXPECT_TRUE(c >= ' ' && c < 0x7f) << line;
    EXPECT_EQ(count_of(line, "$") % 2, 0U) << line;
    EXPECT_EQ(count_of(line, "{") - count_of(line, "\\{"), count_of(line, "}") - count_of(line, "\\}")) << line;
    if (line.starts_with("\\begin{")) open.push_back(line.substr(7, line.find('}') - 7));
    if (line.starts_with("\\begin{tabular}{")) columns = line.size() - std::string("\\begin{tabular}{}").size();
    if (line.starts_with("\\end{")) {
      ASSERT_FALSE(open.empty());
      EXPECT_EQ(line, "\\end{" + open.back() + "}");
      open.pop_back();
    }
    if (line.ends_with("\\\\") && !line.starts_with("\\multicolumn")) {
      EXPECT_EQ(count_of(line, " & ") + 1, columns) << line;
    }
  }
  EXPECT_TRUE(open.empty());
}

TEST(StudyLatex, FilesAreSoundAndTheDocumentHasThemAll) {
  const auto files = study_latex_files(made_up_tables(), made_up_second_tables());
  ASSERT_EQ(files.size(), 7U);
  EXPECT_EQ(files.back().name, "tables.tex");
  for (const auto& file : files) {
    SCOPED_TRACE(file.name);
    expect_sound(file.text);
    if (&file == &files.back()) continue;
    const std::string stem = file.name.substr(0, file.name.size() - 4);
    EXPECT_EQ(count_of(files.back().text, "\\input{" + stem + "}\n"), 1U);
    EXPECT_FALSE(has(file.text, "\\documentclass"));
  }
  EXPECT_TRUE(has(files.back().text, "\\usepackage{booktabs}"));
  // Labels do not meet.
  EXPECT_TRUE(has(files[3].text, "\\label{tab:trained-prey-scores-tag}"));
  EXPECT_FALSE(has(files[3].text, "\\emph{paper}"));
  EXPECT_FALSE(has(files[3].text, "$^{*}$"));
}

}  // namespace
}  // namespace folk::mpe
