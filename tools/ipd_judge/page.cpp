// The report of ipd-judge as one HTML page, and the files.

#include <folk/tools/ipd_judge/output.h>
#include <folk/tools/ipd_judge/words.h>
#include <folk/tools/program/html_document.h>
#include <folk/tools/program/number_text.h>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <folk/games/rational.h>
#include <folk/games/text_file.h>

#include <algorithm>

namespace folk::tools {
namespace {

/// More rows of a table are in report.json alone.
constexpr std::size_t most_rows = 500;

std::string page_title(const JudgeQuestion& question) { return "Who played " + question.file + "?"; }

Html rest(std::size_t rows, const char* what) {
  return rows > most_rows ? paragraph(fmt::format("{} more {} are in report.json.", rows - most_rows, what)) : Html();
}

/// What was asked, every default included.
Html question_list(const JudgeQuestion& question, const Judgement& found) {
  Html list;
  const auto add = [&](const Html& name, const Html& value) { list += element("dt", name) + element("dd", value); };
  add("record", fmt::format("{}: {}, {}", question.file, counted(found.matches.size(), "match", "matches"),
                            counted(question.play.rounds(), "round", "rounds")));
  add("game", question.game.title + ", " + to_text(question.payoffs));
  if (const std::string actions = action_words(question.game); !actions.empty()) add("actions", actions);
  add("strategies", question.players_spec);
  add("opponents", question.opponents_spec);
  std::vector<std::string> slips;
  for (const double slip : question.slips) slips.push_back(to_short_text(slip));
  add("slip rates", fmt::format("{}", fmt::join(slips, ", ")));
  add("before", prior_words(question));
  if (!question.left_out.empty()) add("left out", fmt::format("{}", fmt::join(question.left_out, ", ")));
  if (!question.play.ignored_columns.empty())
    add("ignored columns", fmt::format("{}", fmt::join(question.play.ignored_columns, ", ")));
  add("made by", fmt::format("Folk {}: {}", FOLK_VERSION, question.command));
  return element("dl", list) + "\n";
}

Html players_section(const JudgeQuestion& question, const Judgement& found) {
  Html html = heading(2, "Who played");
  html += paragraph("Of the strategies " + agreement_words(found, most_rows) + ".");
  HtmlTable table({"rank", "strategy", "posterior", "slip rate", "moves otherwise", "first otherwise in"},
                  {"number", "name", "number", "number", "number", "long"});
  const auto rows = candidate_rows(question, found);
  for (std::size_t i = 0; i < std::min(rows.size(), most_rows); ++i) {
    const auto& row = rows[i];
    table.add({std::to_string(row.rank), row.name, share_text(row.posterior), to_short_text(row.slip),
               std::to_string(row.otherwise), row.first_otherwise});
  }
  html += table.html() + rest(rows.size(), "candidates");
  html += paragraph("Slip rate: " + slip_words(question, found) + ".");
  for (const auto& agreement : found.own.class_agreements)
    html += paragraph(agreement.members().name() + ": " + class_words(agreement) + ".");
  return html;
}

Html matches_section(const Judgement& found) {
  Html html = heading(2, "Whom it met");
  html += paragraph("Regret in all: " + regret_words(found) + ".");
  HtmlTable table({"match", "rounds", "score own : theirs", "who agrees with every move of theirs", "likeliest",
                   "regret", "gain, free beliefs", "gain, class of beliefs"},
                  {"name", "number", "number", "long", "long", "number", "number", "number"});
  for (std::size_t m = 0; m < std::min(found.matches.size(), most_rows); ++m) {
    const auto& match = found.matches[m];
    table.add({match.name, std::to_string(match.rounds), to_text(match.own_total) + " : " + to_text(match.their_total),
               met_words(found, match), likeliest_words(found, match), regret_text(match),
               payoff_text(match.free_beliefs.gain),
               match.class_beliefs ? payoff_text(match.class_beliefs->gain) : "-"});
  }
  return html + table.html() + rest(found.matches.size(), "matches");
}

Html beliefs_section(const Judgement& found) {
  if (!found.beliefs) return {};
  Html html = heading(2, "Beliefs");
  html += paragraph("Beliefs: " + belief_words(*found.beliefs) + ".");
  html += paragraph("Moves: " + stage_words(*found.stage) + ".");
  HtmlTable table({"P(C) stated", "rounds", "on average", "C was played"}, {"number", "number", "number", "number"});
  for (std::size_t b = 0; b < found.beliefs->bins.size(); ++b) {
    const auto& bin = found.beliefs->bins[b];
    table.add({bin_text(b), std::to_string(bin.count), share_text(bin.mean_belief()), share_text(bin.frequency())});
  }
  return html + table.html();
}

Html reading_section(const Judgement& found) {
  HtmlTable table({"self-confirming play needs", "", "found"}, {"claim", "verdict", "long"});
  for (const auto& need : needs_of(found))
    table.add({need.what,
               element_of("span", need.holds ? "word yes" : "word no", element("b", need.holds ? "✓ yes" : "✗ no")),
               need.found});
  return heading(2, "Self-confirming play") + table.html();
}

}  // namespace

std::string html_page(const JudgeQuestion& question, const Judgement& found) {
  const Html body = heading(1, page_title(question)) + question_list(question, found) +
                    players_section(question, found) + matches_section(found) + beliefs_section(found) +
                    reading_section(found);
  return html_document("ipd-judge: " + question.file, report_style, body);
}

void write_files(const std::filesystem::path& folder, const JudgeQuestion& question, const Judgement& found) {
  write_file(folder / "report.json", [&](std::ostream& out) { write_json(out, question, found); });
  write_file(folder / "report.html", html_page(question, found));
}

}  // namespace folk::tools
