#include <folk/tools/ipd_tournament/output.h>

#include <folk/tools/choices/game_option.h>
#include <folk/tools/ipd_tournament/invasion_output.h>
#include <folk/tools/ipd_tournament/sub_roster_output.h>
#include <folk/tools/program/csv.h>
#include <folk/tools/program/number_text.h>
#include <folk/tools/program/table.h>

#include <fmt/format.h>
#include <folk/games/error.h>
#include <folk/games/text_file.h>

#include <algorithm>
#include <array>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <iterator>
#include <system_error>
#include <vector>

namespace folk::tools {
namespace {

namespace fs = std::filesystem;

bool sampled(const Tournament& tournament) {
  return std::any_of(tournament.ranking().begin(), tournament.ranking().end(),
                     [](const auto& entry) { return entry.method == Method::sampled; });
}

/// A JSON object: how many pairs (self-play among them) were obtained in which way.
std::string methods_of(const Tournament& tournament) {
  constexpr std::array methods{Method::cycle, Method::played, Method::markov, Method::bounded, Method::sampled};
  std::array<std::size_t, methods.size()> pairs{};
  for (std::size_t i = 0; i < tournament.size(); ++i)
    for (std::size_t j = 0; j <= i; ++j)
      if (tournament.played(i, j)) ++pairs[static_cast<std::size_t>(tournament.method(i, j))];
  std::vector<std::string> items;
  for (const Method method : methods)
    if (const std::size_t count = pairs[static_cast<std::size_t>(method)]; count > 0)
      items.push_back(fmt::format("\"{}\": {}", to_string(method), count));
  return fmt::format("{{{}}}", fmt::join(items, ", "));
}

/// Half the width of the 95 % interval (Student's t) of a total that was sampled; one repetition tells nothing of it.
std::optional<double> confidence(const Tournament& tournament, const RankingEntry& entry) {
  const std::uint64_t repetitions = tournament.settings().repetitions;
  if (entry.method != Method::sampled || repetitions < 2) return std::nullopt;
  // In double, not through long double, of which valgrind has but the range of a double.
  using Policy = boost::math::policies::policy<boost::math::policies::promote_double<false>>;
  const boost::math::students_t_distribution<double, Policy> distribution(static_cast<double>(repetitions - 1));
  return boost::math::quantile(distribution, 0.975) * entry.error;
}

/// The least exact way in which figures of an entrant were obtained, and how many of its pairs were where not all.
std::string figures(const RankingEntry& entry, std::size_t pairs) {
  if (entry.pairs_of_method == pairs) return std::string(to_string(entry.method));
  return fmt::format("{} of {} {}", entry.pairs_of_method, pairs, to_string(entry.method));
}

std::string settings_line(const Tournament& tournament, const TournamentLabels& labels) {
  const auto& settings = tournament.settings();
  std::string text =
      fmt::format("game {}, {}, noise {}, self-play {}, seed {}", game_words(labels.game, settings.payoffs),
                  settings.criterion.to_string(), to_short_text(settings.noise),
                  settings.self_play ? "included" : "left out", settings.seed);
  if (sampled(tournament)) text += fmt::format(", repetitions {}", settings.repetitions.count());
  return text;
}

/// What is told of guesses, in this order.
struct BeliefFigure {
  const char* name;
  std::optional<double> (Guesses::*value)() const;
  const char* file;
};
constexpr std::array<BeliefFigure, 2> belief_figures{
    {{"belief_accuracy", &Guesses::accuracy, "beliefs.csv"},
     {"belief_log_loss", &Guesses::mean_log_loss, "belief_log_loss.csv"}}};

/// Rows of a matrix, streamed as JSON arrays.
template <class Cell>
void write_json_matrix(std::ostream& out, const Tournament& tournament, const char* name, Cell cell) {
  out << fmt::format(",\n  \"{}\": [", name);
  fmt::memory_buffer row;
  for (std::size_t i = 0; i < tournament.size(); ++i) {
    row.clear();
    fmt::format_to(std::back_inserter(row), "{}\n    [", i == 0 ? "" : ",");
    for (std::size_t j = 0; j < tournament.size(); ++j) {
      if (j > 0) row.push_back(',');
      const auto text = tournament.played(i, j) ? cell(i, j) : std::string("null");
      row.append(text.data(), text.data() + text.size());
    }
    row.push_back(']');
    out.write(row.data(), static_cast<std::streamsize>(row.size()));
  }
  out << "\n  ]";
}

/// JSON has no infinity: it is written as in sce-check's.
std::string json_number(const std::optional<double>& value) {
  if (!value) return "null";
  return std::isfinite(*value) ? fmt::format("{}", *value) : "\"infinity\"";
}

std::string csv_number(const std::optional<double>& value) { return value ? fmt::format("{}", *value) : ""; }

void write_json_ranking(std::ostream& out, const Tournament& tournament) {
  out << "  \"ranking\": [";
  const char* separator = "\n";
  for (const auto& entry : tournament.ranking()) {
    out << fmt::format(
        "{}    {{\"rank\": {}, \"name\": {}, \"total\": {}, \"mean\": {}, \"median\": {}, \"wins\": {}, "
        "\"cooperation_rate\": {}, \"normalised\": {}, \"method\": \"{}\", \"confidence_95\": {}, "
        "\"belief_accuracy\": {}, \"belief_log_loss\": {}, \"total_against_roster\": {}, \"pairs_of_method\": {}}}",
        separator, entry.rank, json_string(tournament.name(entry.entrant)), number_text(entry.total), entry.mean,
        entry.median, entry.wins, entry.cooperation_rate, json_number(entry.normalised), to_string(entry.method),
        json_number(confidence(tournament, entry)), json_number(entry.guesses.accuracy()),
        json_number(entry.guesses.mean_log_loss()), number_text(entry.total_against_roster), entry.pairs_of_method);
    separator = ",\n";
  }
  out << "\n  ]";
}

/// How each figure was obtained, a string a row and a letter a cell: c(ycle), p(layed), m(arkov), b(ounded), s(ampled),
/// - not played.
void write_json_methods(std::ostream& out, const Tournament& tournament) {
  out << ",\n  \"method_rows\": [";
  for (std::size_t i = 0; i < tournament.size(); ++i) {
    std::string row;
    for (std::size_t j = 0; j < tournament.size(); ++j)
      row += tournament.played(i, j) ? to_string(tournament.method(i, j)).front() : '-';
    out << (i == 0 ? "\n    \"" : ",\n    \"") << row << '"';
  }
  out << "\n  ]";
}

template <class Cell>
void write_csv_matrix(std::ostream& out, const Tournament& tournament, Cell cell) {
  out << "row\\col";
  for (std::size_t j = 0; j < tournament.size(); ++j) out << ',' << csv_field(tournament.name(j));
  out << '\n';
  for (std::size_t i = 0; i < tournament.size(); ++i) {
    out << csv_field(tournament.name(i));
    for (std::size_t j = 0; j < tournament.size(); ++j) {
      out << ',';
      if (tournament.played(i, j)) out << number_text(static_cast<long double>(cell(i, j)));
    }
    out << '\n';
  }
}

/// A row a pair: both scores, the share of each outcome (the first player's move first), who won, how the figures were
/// obtained, the standard errors of both scores.
void write_pairs_csv(std::ostream& out, const Tournament& tournament) {
  out << "a,b,score_a,score_b,CC,CD,DC,DD,winner,figures,standard_error_a,standard_error_b\n";
  const double weight = tournament.settings().criterion.total_weight();
  const double all = weight > 0 ? weight : 1;
  fmt::memory_buffer rows;
  for (std::size_t i = 0; i < tournament.size(); ++i) {
    rows.clear();
    for (std::size_t j = i; j < tournament.size(); ++j) {
      if (!tournament.played(i, j)) continue;
      const OutcomeWeights outcomes = tournament.outcomes(i, j);
      const char* winner = i != j && tournament.wins(i, j) ? "a" : i != j && tournament.wins(j, i) ? "b" : "";
      fmt::format_to(std::back_inserter(rows), "{},{},{},{},{},{},{},{},{},{},{},{}\n", csv_field(tournament.name(i)),
                     csv_field(tournament.name(j)), number_text(static_cast<long double>(tournament.score(i, j))),
                     number_text(static_cast<long double>(tournament.score(j, i))), outcomes[0] / all,
                     outcomes[1] / all, outcomes[2] / all, outcomes[3] / all, winner,
                     to_string(tournament.method(i, j)), tournament.standard_error(i, j),
                     tournament.standard_error(j, i));
    }
    out.write(rows.data(), static_cast<std::streamsize>(rows.size()));
  }
}

/// A figure of whose guesses of whose moves, entrants with beliefs alone as rows; the last column is of all guesses.
void write_beliefs_csv(std::ostream& out, const Tournament& tournament, const BeliefFigure& figure) {
  out << "row\\col";
  for (std::size_t j = 0; j < tournament.size(); ++j) out << ',' << csv_field(tournament.name(j));
  out << ",all\n";
  std::vector<std::optional<double>> all(tournament.size());
  for (const auto& entry : tournament.ranking()) all[entry.entrant] = (entry.guesses.*figure.value)();
  for (std::size_t i = 0; i < tournament.size(); ++i) {
    if (!all[i]) continue;
    out << csv_field(tournament.name(i));
    for (std::size_t j = 0; j < tournament.size(); ++j)
      out << ',' << (tournament.played(i, j) ? csv_number((tournament.guesses(i, j).*figure.value)()) : "");
    out << ',' << csv_number(all[i]) << '\n';
  }
}

}  // namespace

void write_text(std::ostream& out, const Tournament& tournament, const TournamentLabels& labels,
                const TournamentExtras& extras) {
  out << visible_line(fmt::format("Round robin of {} strategies: {}{}", tournament.size(), labels.roster,
                                  labels.included.empty() ? "" : ", with " + labels.included));
  out << settings_line(tournament, labels) << "\n\n";
  const bool with_error = sampled(tournament);
  std::vector<std::string> header{"rank", "strategy", "total"};
  if (with_error) header.emplace_back("95 %");
  const bool with_guests = tournament.core() < tournament.size();
  if (with_guests) header.emplace_back("v roster");
  for (const char* name : {"mean", "median", "wins", "coop %", "normalised"}) header.emplace_back(name);
  if (tournament.has_beliefs()) header.insert(header.end(), {"belief", "log loss"});
  header.emplace_back("figures");
  Table table(header);
  for (const auto& entry : tournament.ranking()) {
    std::vector<std::string> row{fmt::format("{}", entry.rank), tournament.name(entry.entrant),
                                 total_text(entry.total)};
    if (with_error) {
      const auto half = confidence(tournament, entry);
      row.push_back(half ? fmt::format("±{:.4g}", *half) : "");
    }
    if (with_guests) row.push_back(entry.entrant < tournament.core() ? "" : total_text(entry.total_against_roster));
    row.push_back(fmt::format("{:.4f}", entry.mean));
    row.push_back(fmt::format("{:.4f}", entry.median));
    row.push_back(fmt::format("{}", entry.wins));
    row.push_back(fmt::format("{:.2f}", 100 * entry.cooperation_rate));
    row.push_back(entry.normalised ? fmt::format("{:.2f}", *entry.normalised) : "-");
    if (tournament.has_beliefs()) {
      const auto accuracy = entry.guesses.accuracy();
      row.push_back(accuracy ? fmt::format("{:.2f} %", 100 * *accuracy) : "");
      row.push_back(accuracy ? fmt::format("{:.4f}", *entry.guesses.mean_log_loss()) : "");
    }
    row.push_back(figures(entry, tournament.opponents()));
    table.add(std::move(row));
  }
  out << table.text();
  out << "\nmean and median: payoff a round; normalised: 100 x payoff / the roster's mean against the same opponent\n";
  if (with_guests)
    out << fmt::format("v roster: total of an included entrant against the {} of the roster alone\n",
                       tournament.core());
  if (tournament.has_beliefs())
    out << "belief: how often the move that it held likelier was the other's move; log loss: mean of -ln of the "
           "probability that it gave to the other's move\n";
  for (const auto& caveat : tournament.caveats()) out << visible_line("note: " + caveat);
  out << fmt::format("signature {:016x}\n", tournament.signature());
  if (extras.invasions != nullptr) write_invasion_text(out, tournament, *extras.invasions);
  if (extras.sub_rosters != nullptr) write_sub_rosters_text(out, tournament, *extras.sub_rosters);
}

void write_ranking_csv(std::ostream& out, const Tournament& tournament, const TournamentExtras& extras) {
  out << "rank,strategy,total,mean,median,wins,cooperation_rate,normalised,method,confidence_95,belief_accuracy,"
         "belief_log_loss,total_against_roster,pairs_of_method"
      << (extras.invasions != nullptr ? fmt::format(",{}", invasion_csv_columns) : "")
      << (extras.sub_rosters != nullptr ? fmt::format(",{}", sub_roster_csv_columns) : "") << '\n';
  fmt::memory_buffer rows;
  for (const auto& entry : tournament.ranking())
    fmt::format_to(
        std::back_inserter(rows), "{},{},{},{},{},{},{},{},{},{},{},{},{},{}{}{}\n", entry.rank,
        csv_field(tournament.name(entry.entrant)), number_text(entry.total), entry.mean, entry.median, entry.wins,
        entry.cooperation_rate, csv_number(entry.normalised), to_string(entry.method),
        csv_number(confidence(tournament, entry)), csv_number(entry.guesses.accuracy()),
        csv_number(entry.guesses.mean_log_loss()), number_text(entry.total_against_roster), entry.pairs_of_method,
        extras.invasions != nullptr ? "," + invasion_csv_fields(*extras.invasions, entry.entrant) : "",
        extras.sub_rosters != nullptr ? "," + sub_roster_csv_fields(extras.sub_rosters->ranks[entry.entrant]) : "");
  out.write(rows.data(), static_cast<std::streamsize>(rows.size()));
}

void write_json(std::ostream& out, const Tournament& tournament, const TournamentLabels& labels, bool with_matrices,
                const TournamentExtras& extras) {
  const auto& settings = tournament.settings();
  out << "{\n";
  if (!with_matrices)
    out << fmt::format("  \"folk_version\": \"{}\",\n  \"command\": {},\n", FOLK_VERSION, json_string(labels.command));
  out << fmt::format("  \"game\": {},\n  \"payoffs\": {},\n  \"criterion\": \"{}\",\n  \"rounds\": {},\n",
                     json_string(labels.game), payoffs_json(settings.payoffs), settings.criterion.to_string(),
                     settings.criterion.is_finite() ? fmt::format("{}", settings.criterion.rounds()) : "null");
  out << fmt::format("  \"noise\": {},\n  \"self_play\": {},\n  \"repetitions\": {},\n  \"seed\": {},\n",
                     settings.noise.probability(), settings.self_play, settings.repetitions.count(), settings.seed);
  out << fmt::format("  \"roster\": {},\n  \"included\": {},\n  \"behaviours\": {},\n  \"methods\": {},\n",
                     json_string(labels.roster), json_string(labels.included), tournament.behaviours(),
                     methods_of(tournament));
  out << fmt::format("  \"signature\": \"{:016x}\",\n  \"strategies\": [", tournament.signature());
  for (std::size_t i = 0; i < tournament.size(); ++i) out << (i > 0 ? ", " : "") << json_string(tournament.name(i));
  out << "],\n  \"notes\": [";
  const auto caveats = tournament.caveats();
  for (std::size_t i = 0; i < caveats.size(); ++i) out << (i > 0 ? ", " : "") << json_string(caveats[i]);
  out << "],\n";
  write_json_ranking(out, tournament);
  if (with_matrices) {
    write_json_methods(out, tournament);
    write_json_matrix(out, tournament, "scores", [&](std::size_t i, std::size_t j) {
      return number_text(static_cast<long double>(tournament.score(i, j)));
    });
    write_json_matrix(out, tournament, "cooperations", [&](std::size_t i, std::size_t j) {
      return number_text(static_cast<long double>(tournament.cooperation(i, j)));
    });
    write_json_matrix(out, tournament, "normalised",
                      [&](std::size_t i, std::size_t j) { return json_number(tournament.normalised(i, j)); });
    for (const BeliefFigure& figure : belief_figures)
      if (tournament.has_beliefs())
        write_json_matrix(out, tournament, figure.name, [&](std::size_t i, std::size_t j) {
          return json_number((tournament.guesses(i, j).*figure.value)());
        });
      else
        out << fmt::format(",\n  \"{}\": null", figure.name);
  }
  if (extras.invasions != nullptr) write_invasion_json(out, *extras.invasions);
  if (extras.sub_rosters != nullptr) write_sub_rosters_json(out, tournament, *extras.sub_rosters);
  out << "\n}\n";
}

void write_files(const fs::path& folder, const Tournament& tournament, const TournamentLabels& labels,
                 const TournamentExtras& extras) {
  write_file(folder / "ranking.csv", [&](std::ostream& out) { write_ranking_csv(out, tournament, extras); });
  write_file(folder / "scores.csv", [&](std::ostream& out) {
    write_csv_matrix(out, tournament, [&](std::size_t i, std::size_t j) { return tournament.score(i, j); });
  });
  write_file(folder / "cooperation.csv", [&](std::ostream& out) {
    write_csv_matrix(out, tournament, [&](std::size_t i, std::size_t j) { return tournament.cooperation(i, j); });
  });
  if (tournament.size() <= most_listed_pairs)
    write_file(folder / "pairs.csv", [&](std::ostream& out) { write_pairs_csv(out, tournament); });
  if (tournament.has_beliefs())
    for (const BeliefFigure& figure : belief_figures)
      write_file(folder / figure.file, [&](std::ostream& out) { write_beliefs_csv(out, tournament, figure); });
  if (extras.invasions != nullptr)
    write_file(folder / "invasion.csv",
               [&](std::ostream& out) { write_invasion_csv(out, tournament, *extras.invasions); });
  if (extras.sub_rosters != nullptr)
    write_file(folder / "sub_rosters.csv",
               [&](std::ostream& out) { write_sub_rosters_csv(out, tournament, *extras.sub_rosters); });
  write_file(folder / "summary.json", [&](std::ostream& out) { write_json(out, tournament, labels, false, extras); });
}

}  // namespace folk::tools
