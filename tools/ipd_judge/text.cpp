// What ipd-judge found, as text for people and as CSV.

#include <folk/tools/ipd_judge/output.h>
#include <folk/tools/ipd_judge/words.h>
#include <folk/tools/program/csv.h>
#include <folk/tools/program/number_text.h>
#include <folk/tools/program/table.h>

#include <fmt/format.h>
#include <folk/games/rational.h>

#include <algorithm>

namespace folk::tools {
namespace {

void write_rest(std::ostream& out, std::size_t rows, std::size_t shown, const char* what) {
  if (rows > shown) out << fmt::format("and {} more {}: --show {} shows all\n", rows - shown, what, rows);
}

void write_header(std::ostream& out, const JudgeQuestion& question, const Judgement& found) {
  out << visible_line(fmt::format("{}, {}, in {}", counted(found.matches.size(), "match", "matches"),
                                  counted(question.play.rounds(), "round", "rounds"), question.file));
  out << game_words(question.game.title, question.payoffs) << "\n";
  if (const std::string actions = action_words(question.game); !actions.empty()) out << visible_line(actions);
  out << visible_line(fmt::format("strategies {}, opponents {}", question.players_spec, question.opponents_spec));
  out << "before: " << prior_words(question) << "\n";
}

void write_players(std::ostream& out, const JudgeQuestion& question, const Judgement& found) {
  out << "\n" << visible_line("who played: " + agreement_words(found, question.shown));
  const auto rows = candidate_rows(question, found);
  Table table({"rank", "strategy", "posterior", "slip", "otherwise", "first otherwise in"});
  for (std::size_t i = 0; i < std::min(rows.size(), question.shown); ++i) {
    const auto& row = rows[i];
    table.add({std::to_string(row.rank), row.name, share_text(row.posterior), to_short_text(row.slip),
               std::to_string(row.otherwise), row.first_otherwise});
  }
  out << table.text();
  write_rest(out, rows.size(), question.shown, "candidates");
  out << "slip rate: " << slip_words(question, found) << "\n";
  for (const auto& agreement : found.own.class_agreements)
    out << fmt::format("{}: {}\n", agreement.members().name(), class_words(agreement));
}

void write_matches(std::ostream& out, const JudgeQuestion& question, const Judgement& found) {
  out << "\nwhom it met: who agrees with every move of theirs, and how much more a best reply would have earned\n";
  Table table({"match", "rounds", "own", "theirs", "agree", "likeliest", "regret"});
  for (std::size_t m = 0; m < std::min(found.matches.size(), question.shown); ++m) {
    const auto& match = found.matches[m];
    table.add({match.name, std::to_string(match.rounds), to_text(match.own_total), to_text(match.their_total),
               met_words(found, match), likeliest_words(found, match), regret_text(match)});
  }
  out << table.text();
  write_rest(out, found.matches.size(), question.shown, "matches");
  out << "regret in all: " << regret_words(found) << "\n";
}

void write_beliefs(std::ostream& out, const Judgement& found) {
  if (!found.beliefs) return;
  const auto& beliefs = *found.beliefs;
  out << "\nbeliefs: " << belief_words(beliefs) << "\n";
  out << "moves: " << stage_words(*found.stage) << "\n";
  Table table({"P(C) stated", "rounds", "on average", "C was played"});
  for (std::size_t b = 0; b < beliefs.bins.size(); ++b)
    if (const auto& bin = beliefs.bins[b]; bin.count > 0)
      table.add({bin_text(b), std::to_string(bin.count), share_text(bin.mean_belief()), share_text(bin.frequency())});
  out << table.text();
}

void write_reading(std::ostream& out, const Judgement& found) {
  out << "\nself-confirming play needs\n";
  for (const auto& need : needs_of(found))
    out << visible_line(fmt::format("  {} {}: {}", need.holds ? "yes" : "no ", need.what, need.found));
}

}  // namespace

void write_text(std::ostream& out, const JudgeQuestion& question, const Judgement& found) {
  write_header(out, question, found);
  write_players(out, question, found);
  write_matches(out, question, found);
  write_beliefs(out, found);
  write_reading(out, found);
}

void write_csv(std::ostream& out, const JudgeQuestion& question, const Judgement& found) {
  out << "rank,strategy,weight,posterior,slip,otherwise\n";
  for (const auto& row : candidate_rows(question, found))
    out << fmt::format("{},{},{},{},{},{}\n", row.rank, csv_field(row.name), number_text(row.weight), row.posterior,
                       to_short_text(row.slip), row.otherwise);
}

}  // namespace folk::tools
