#include <folk/tools/choices/game_option.h>
#include <folk/tools/ipd_tournament/class_output.h>
#include <folk/tools/program/csv.h>
#include <folk/tools/program/number_text.h>
#include <folk/tools/program/table.h>

#include <fmt/format.h>
#include <folk/games/text_file.h>

#include <algorithm>
#include <iterator>

namespace folk::tools {
namespace {

/// Rows are handed to a stream in pieces of this size.
constexpr std::size_t piece = std::size_t{1} << 16;

void hand_over(std::ostream& out, fmt::memory_buffer& rows, std::size_t from) {
  if (rows.size() <= from) return;
  out.write(rows.data(), static_cast<std::streamsize>(rows.size()));
  rows.clear();
}

/// What was played, for text.
std::string game_line(const Payoffs& payoffs, const Criterion& criterion, const ClassLabels& labels) {
  return fmt::format("game {}, {}, noise 0", game_words(labels.game, payoffs), criterion.to_string());
}

/// The same as members of a JSON object, without the braces.
std::string game_json(const Payoffs& payoffs, const Criterion& criterion, const MemoryClass& members,
                      const ClassLabels& labels) {
  return fmt::format(
      "  \"game\": {},\n  \"payoffs\": {},\n  \"criterion\": \"{}\",\n  \"rounds\": {},\n  \"noise\": 0,\n"
      "  \"class\": \"{}\",\n  \"class_size\": \"{}\",\n",
      json_string(labels.game), payoffs_json(payoffs), criterion.to_string(),
      criterion.is_finite() ? fmt::format("{}", criterion.rounds()) : "null", members.name(), members.size().str());
}

std::string origin_json(const ClassLabels& labels) {
  return fmt::format("  \"folk_version\": \"{}\",\n  \"command\": {},\n", FOLK_VERSION, json_string(labels.command));
}

/// A row of a ranking.
struct Row {
  std::size_t rank = 0;
  std::uint32_t member = 0;
  std::uint32_t genotypes = 1;  ///< that it stands for
};

/// Calls with each row; `row` returns false when it has seen enough. Ranks count rows.
template <class Each>
void for_rows(const ClassTournament& tournament, const ClassLabels& labels, Each row) {
  std::size_t count = 0;
  std::size_t rank = 0;
  std::uint32_t rank_of_members = 0;
  for (const auto& place : tournament.ranking()) {
    std::uint32_t genotypes = 1;
    if (labels.behaviours) {
      const std::uint32_t behaviour = labels.behaviours->of_member[place.member];
      if (labels.behaviours->first[behaviour] != place.member) continue;
      genotypes = labels.behaviours->members[behaviour];
    }
    ++count;
    if (place.rank != rank_of_members) rank = count;
    rank_of_members = place.rank;
    if (!row(Row{rank, place.member, genotypes})) return;
  }
}

std::size_t rows_of(const ClassTournament& tournament, const ClassLabels& labels) {
  return labels.behaviours ? labels.behaviours->size() : tournament.size();
}

/// A member's share in all, as a number.
double share(const Integer& count, const MemoryClass& members) { return nearest_quotient(count, members.size()); }

}  // namespace

void write_class_text(std::ostream& out, const ClassTournament& tournament, const ClassLabels& labels) {
  const auto& settings = tournament.settings();
  out << fmt::format("Round robin of all {} members of {}", tournament.size(), tournament.members().name());
  if (labels.behaviours) out << fmt::format(", {} behaviours", labels.behaviours->size());
  out << '\n'
      << visible_line(game_line(settings.payoffs, settings.criterion, labels) +
                      (settings.self_play ? ", self-play included" : ", self-play left out"))
      << '\n';
  std::vector<std::string> header{"rank", "member", "total", "mean", "wins", "draws", "coop %"};
  if (labels.behaviours) header.emplace_back("genotypes");
  Table table(header);
  std::size_t shown = 0;
  for_rows(tournament, labels, [&](const Row& row) {
    const auto& totals = tournament.totals(row.member);
    std::vector<std::string> cells{fmt::format("{}", row.rank),
                                   tournament.name(row.member),
                                   total_text(tournament.total(row.member)),
                                   fmt::format("{:.4f}", tournament.mean(row.member)),
                                   fmt::format("{}", totals.wins),
                                   fmt::format("{}", totals.draws),
                                   fmt::format("{:.2f}", 100 * tournament.cooperation_rate(row.member))};
    if (labels.behaviours) cells.push_back(fmt::format("{}", row.genotypes));
    table.add(std::move(cells));
    return ++shown < most_shown_members;
  });
  out << table.text();
  if (const std::size_t all = rows_of(tournament, labels); shown < all)
    out << fmt::format("... the first {} of {}: --format csv and --output have all\n", shown, all);
  out << "\nmean: payoff a round; draws: opponents that scored as much, its own copy among them\n";
  if (labels.behaviours) out << "genotypes: members that no opponent can tell from this one, itself among them\n";
  if (!tournament.exact()) out << "scores of pairs are rounded to fourteen digits or more\n";
  out << fmt::format("signature {:016x}\n", tournament.signature());
}

void write_class_csv(std::ostream& out, const ClassTournament& tournament, const ClassLabels& labels) {
  out << "rank,strategy,total,mean,wins,draws,cooperation_rate" << (labels.behaviours ? ",genotypes\n" : "\n");
  fmt::memory_buffer rows;
  for_rows(tournament, labels, [&](const Row& row) {
    const auto& totals = tournament.totals(row.member);
    fmt::format_to(std::back_inserter(rows), "{},{},{},{},{},{},{}", row.rank, tournament.name(row.member),
                   number_text(tournament.total(row.member)), tournament.mean(row.member), totals.wins, totals.draws,
                   tournament.cooperation_rate(row.member));
    if (labels.behaviours) fmt::format_to(std::back_inserter(rows), ",{}", row.genotypes);
    rows.push_back('\n');
    hand_over(out, rows, piece);
    return true;
  });
  hand_over(out, rows, 0);
}

void write_class_json(std::ostream& out, const ClassTournament& tournament, const ClassLabels& labels, bool kept) {
  const auto& settings = tournament.settings();
  out << "{\n" << (kept ? origin_json(labels) : "");
  out << game_json(settings.payoffs, settings.criterion, tournament.members(), labels);
  out << fmt::format("  \"self_play\": {},\n  \"exact\": {},\n  \"behaviours\": {},\n  \"signature\": \"{:016x}\"",
                     settings.self_play, tournament.exact(),
                     labels.behaviours ? fmt::format("{}", labels.behaviours->size()) : "null", tournament.signature());
  if (!kept) {
    out << ",\n  \"ranking\": [";
    fmt::memory_buffer rows;
    const char* separator = "\n";
    for_rows(tournament, labels, [&](const Row& row) {
      const auto& totals = tournament.totals(row.member);
      fmt::format_to(
          std::back_inserter(rows),
          "{}    {{\"rank\": {}, \"name\": \"{}\", \"total\": {}, \"mean\": {}, \"wins\": {}, \"draws\": {}, "
          "\"cooperation_rate\": {}, \"genotypes\": {}}}",
          separator, row.rank, tournament.name(row.member), number_text(tournament.total(row.member)),
          tournament.mean(row.member), totals.wins, totals.draws, tournament.cooperation_rate(row.member),
          row.genotypes);
      separator = ",\n";
      hand_over(out, rows, piece);
      return true;
    });
    hand_over(out, rows, 0);
    out << "\n  ]";
  }
  out << "\n}\n";
}

void write_class_files(const std::filesystem::path& folder, const ClassTournament& tournament,
                       const ClassLabels& labels) {
  write_file(folder / "ranking.csv", [&](std::ostream& out) { write_class_csv(out, tournament, labels); });
  write_file(folder / "summary.json", [&](std::ostream& out) { write_class_json(out, tournament, labels, true); });
}

void write_scores_text(std::ostream& out, const ClassScores& scores, const ClassLabels& labels) {
  out << fmt::format("{} {} against all {} members of {}\n", scores.entrants.size(),
                     scores.entrants.size() == 1 ? "strategy" : "strategies", scores.members.size_text(),
                     scores.members.name());
  out << visible_line(game_line(scores.settings.payoffs, scores.settings.criterion, labels)) << '\n';
  Table table({"strategy", "mean", "coop %", "beats %", "ties %", "loses %", "best", "worst", "leaves"});
  const auto percent = [&](const Integer& count) { return fmt::format("{:.2f}", 100 * share(count, scores.members)); };
  for (const auto& [name, score] : scores.entrants)
    table.add({name, fmt::format("{:.4f}", score.mean), fmt::format("{:.2f}", 100 * score.cooperation_rate),
               percent(score.beats), percent(score.draws), percent(score.loses), fmt::format("{:.4f}", score.best.mean),
               fmt::format("{:.4f}", score.worst.mean), fmt::format("{}", score.leaves)});
  out << table.text();
  for (const auto& [name, reason] : scores.left_out)
    out << visible_line(fmt::format("note: {} is left out: {}", name, reason));
  out << "\nmean: payoff a round; beats, ties, loses: shares of the class; best and worst: the mean against the "
         "members "
         "it\ndoes best and worst against (--format json names them); leaves: kinds of opponents told apart\n";
}

void write_scores_csv(std::ostream& out, const ClassScores& scores) {
  out << "strategy,mean,cooperation_rate,beats,ties,loses,best_mean,best_member,worst_mean,worst_member,leaves\n";
  for (const auto& [name, score] : scores.entrants)
    out << fmt::format("{},{},{},{},{},{},{},{},{},{},{}\n", csv_field(name), score.mean, score.cooperation_rate,
                       share(score.beats, scores.members), share(score.draws, scores.members),
                       share(score.loses, scores.members), score.best.mean, score.best.member, score.worst.mean,
                       score.worst.member, score.leaves);
}

void write_scores_json(std::ostream& out, const ClassScores& scores, const ClassLabels& labels) {
  out << "{\n" << origin_json(labels);
  out << game_json(scores.settings.payoffs, scores.settings.criterion, scores.members, labels);
  out << "  \"entrants\": [";
  const char* separator = "\n";
  const auto fraction = [](const std::optional<Rational>& value) {
    return value ? fmt::format("\"{}\"", to_text(*value)) : std::string("null");
  };
  for (const auto& [name, score] : scores.entrants) {
    out << fmt::format(
        "{}    {{\"name\": {}, \"mean\": {}, \"exact_mean\": {}, \"cooperation_rate\": {}, "
        "\"exact_cooperation_rate\": {}, \"beats\": {}, \"ties\": {}, \"loses\": {}, \"members_beaten\": \"{}\", "
        "\"members_tied\": \"{}\", \"members_lost_to\": \"{}\", \"best\": {{\"mean\": {}, \"member\": \"{}\"}}, "
        "\"worst\": {{\"mean\": {}, \"member\": \"{}\"}}, \"leaves\": {}}}",
        separator, json_string(name), score.mean, fraction(score.exact_mean), score.cooperation_rate,
        fraction(score.exact_cooperation_rate), share(score.beats, scores.members), share(score.draws, scores.members),
        share(score.loses, scores.members), score.beats.str(), score.draws.str(), score.loses.str(), score.best.mean,
        score.best.member, score.worst.mean, score.worst.member, score.leaves);
    separator = ",\n";
  }
  out << "\n  ],\n  \"left_out\": [";
  separator = "";
  for (const auto& [name, reason] : scores.left_out) {
    out << fmt::format("{}{{\"name\": {}, \"reason\": {}}}", separator, json_string(name), json_string(reason));
    separator = ", ";
  }
  out << "]\n}\n";
}

void write_scores_files(const std::filesystem::path& folder, const ClassScores& scores, const ClassLabels& labels) {
  write_file(folder / "class.csv", [&](std::ostream& out) { write_scores_csv(out, scores); });
  write_file(folder / "summary.json", [&](std::ostream& out) { write_scores_json(out, scores, labels); });
}

}  // namespace folk::tools
