#include <folk/tools/ipd_evolve/evolution_output.h>
#include <folk/tools/ipd_evolve/fixation_output.h>

#include <folk/tools/program/csv.h>
#include <folk/tools/program/number_text.h>
#include <folk/tools/program/table.h>

#include <fmt/format.h>
#include <folk/analysis/play/signature.h>
#include <folk/games/text_file.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

namespace folk::tools {
namespace {

namespace fs = std::filesystem;

/// Longer fractions are cut in the text.
constexpr std::size_t longest_fraction = 40;

std::string fraction_text(const Rational& value) {
  const std::string text = value.str();
  if (text.size() <= longest_fraction) return text;
  return fmt::format("{}.../{}...", text.substr(0, 12), value.denominator().str().substr(0, 12));
}

/// Against 1 / N, up to rounding.
const char* selection_text(double ratio) {
  constexpr double neutral_within = 1e-9;
  return ratio > 1 + neutral_within ? "favoured" : ratio < 1 - neutral_within ? "opposed" : "neutral";
}

/// Calls visit(resident, mutant) for all pairs of different ones.
void for_pairs(std::size_t n, const std::function<void(std::size_t, std::size_t)>& visit) {
  for (std::size_t resident = 0; resident < n; ++resident)
    for (std::size_t mutant = 0; mutant < n; ++mutant)
      if (mutant != resident) visit(resident, mutant);
}

/// Strategies by their share, the largest first, equal ones in roster order.
std::vector<std::size_t> ranked(const std::vector<double>& shares) {
  std::vector<std::size_t> order(shares.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return shares[a] > shares[b]; });
  return order;
}

std::uint64_t signature_of(const FixationReport& report) {
  Signature signature;
  signature.add(report.played.scores->signature());
  signature.add(report.question.rules.text());
  signature.add(report.fixation.population);
  for (const long double logarithm : report.fixation.logarithms) signature.add(static_cast<double>(logarithm));
  for (const double share : report.distribution) signature.add(share);
  return signature.value();
}

std::uint64_t signature_of(const RunsReport& report) {
  Signature signature;
  signature.add(report.played.scores->signature());
  signature.add(report.question.dynamics->text());
  signature.add(report.seed);
  for (const double number : report.question.start) signature.add(number);
  for (const std::uint64_t count : report.counts.taken_over) signature.add(count);
  signature.add(report.counts.unsettled);
  return signature.value();
}

void write_opening(std::ostream& out, const PlayedScores& played, const std::string& what, const std::string& how,
                   std::uint64_t seed) {
  out << visible_line(fmt::format("{}: {}", what, played.roster));
  out << visible_line(fmt::format("{}, seed {}", played.line, seed));
  out << visible_line(how) << '\n';
}

void write_closing(std::ostream& out, const PlayedScores& played, std::uint64_t signature) {
  for (const auto& caveat : played.caveats) out << visible_line("note: " + caveat);
  out << fmt::format("signature {:016x}\n", signature);
}

void write_pairs_text(std::ostream& out, const FixationReport& report) {
  const auto& names = report.played.scores->names();
  const auto& fixation = report.fixation;
  std::vector<std::string> header{"resident", "mutant", "probability", "x N", "selection"};
  if (!fixation.exact.empty()) header.emplace_back("exact");
  Table table(header);
  for_pairs(names.size(), [&](std::size_t resident, std::size_t mutant) {
    std::vector<std::string> row{
        names[resident], names[mutant], fmt::format("{:.6g}", fixation.probability(mutant, resident)),
        fmt::format("{:.4g}", fixation.ratio(mutant, resident)), selection_text(fixation.ratio(mutant, resident))};
    if (!fixation.exact.empty()) row.push_back(fraction_text(fixation.exact[resident * names.size() + mutant]));
    table.add(std::move(row));
  });
  out << table.text()
      << "\nprobability: that a single mutant takes over; x N: over that of a neutral one, 1 / N, which selection "
         "favours, or opposes\n";
}

void write_distribution_text(std::ostream& out, const FixationReport& report) {
  const auto& names = report.played.scores->names();
  std::vector<std::string> header{"rank", "strategy", "share %"};
  if (!report.exact_distribution.empty()) header.emplace_back("exact");
  Table table(header);
  std::size_t rank = 0;
  for (const std::size_t i : ranked(report.distribution)) {
    std::vector<std::string> row{fmt::format("{}", ++rank), names[i],
                                 fmt::format("{:.4f}", 100 * report.distribution[i])};
    if (!report.exact_distribution.empty()) row.push_back(fraction_text(report.exact_distribution[i]));
    table.add(std::move(row));
  }
  out << table.text()
      << "\nshare: of the time that all are of this strategy, mutations being rare (Fudenberg & Imhof 2006)\n";
}

void write_pairs_csv(std::ostream& out, const FixationReport& report) {
  const auto& names = report.played.scores->names();
  const auto& fixation = report.fixation;
  const bool exact = !fixation.exact.empty();
  out << "resident,mutant,probability,ratio_to_neutral" << (exact ? ",exact" : "") << '\n';
  for_pairs(names.size(), [&](std::size_t resident, std::size_t mutant) {
    out << fmt::format("{},{},{},{}{}\n", csv_field(names[resident]), csv_field(names[mutant]),
                       fixation.probability(mutant, resident), fixation.ratio(mutant, resident),
                       exact ? "," + fixation.exact[resident * names.size() + mutant].str() : "");
  });
}

void write_distribution_csv(std::ostream& out, const FixationReport& report) {
  const bool exact = !report.exact_distribution.empty();
  out << "rank,name,share" << (exact ? ",exact" : "") << '\n';
  std::size_t rank = 0;
  for (const std::size_t i : ranked(report.distribution))
    out << fmt::format("{},{},{}{}\n", ++rank, csv_field(report.played.scores->names()[i]), report.distribution[i],
                       exact ? "," + report.exact_distribution[i].str() : "");
}

void write_json_opening(std::ostream& out, const PlayedScores& played, const EvolveQuestion& question,
                        std::uint64_t seed, std::uint64_t signature, const std::string* command) {
  out << "{\n";
  if (command != nullptr)
    out << fmt::format("  \"folk_version\": \"{}\",\n  \"command\": {},\n", FOLK_VERSION, json_string(*command));
  for (const auto& [name, value] : played.members) out << fmt::format("  \"{}\": {},\n", name, value);
  out << fmt::format("  \"seed\": {},\n  \"model\": {},\n  \"parameters\": {},\n", seed, json_string(question.model),
                     json_string(question.dynamics ? question.dynamics->text() : question.rules.text()));
  out << "  \"notes\": [";
  for (std::size_t i = 0; i < played.caveats.size(); ++i) out << (i > 0 ? ", " : "") << json_string(played.caveats[i]);
  out << fmt::format("],\n  \"signature\": \"{:016x}\"", signature);
}

void write_fixation_json(std::ostream& out, const FixationReport& report, bool as_file) {
  const auto& names = report.played.scores->names();
  const auto& fixation = report.fixation;
  write_json_opening(out, report.played, report.question, report.seed, signature_of(report),
                     as_file ? &report.command : nullptr);
  out << fmt::format(",\n  \"individuals\": {}", fixation.population);
  if (!report.distribution.empty()) {
    out << ",\n  \"ranking\": [";
    std::size_t rank = 0;
    for (const std::size_t i : ranked(report.distribution)) {
      ++rank;
      out << fmt::format("{}\n    {{\"rank\": {}, \"name\": {}, \"share\": {}", rank == 1 ? "" : ",", rank,
                         json_string(names[i]), report.distribution[i]);
      if (!report.exact_distribution.empty())
        out << fmt::format(", \"exact\": \"{}\"", report.exact_distribution[i].str());
      out << '}';
    }
    out << "\n  ]";
  }
  out << ",\n  \"fixation\": [";
  const char* separator = "\n";
  for_pairs(names.size(), [&](std::size_t resident, std::size_t mutant) {
    out << fmt::format("{}    {{\"resident\": {}, \"mutant\": {}, \"probability\": {}, \"ratio_to_neutral\": {}",
                       separator, json_string(names[resident]), json_string(names[mutant]),
                       fixation.probability(mutant, resident), fixation.ratio(mutant, resident));
    if (!fixation.exact.empty())
      out << fmt::format(", \"exact\": \"{}\"", fixation.exact[resident * names.size() + mutant].str());
    out << '}';
    separator = ",\n";
  });
  out << "\n  ]\n}\n";
}

void write_runs_csv(std::ostream& out, const RunsReport& report) {
  const auto& names = report.played.scores->names();
  std::vector<double> shares;
  for (std::size_t i = 0; i < names.size(); ++i) shares.push_back(report.counts.share(i));
  out << "rank,name,start,taken_over,share,standard_error,exact\n";
  std::size_t rank = 0;
  for (const std::size_t i : ranked(shares)) {
    const auto exact = expected_share(report, i);
    out << fmt::format("{},{},{},{},{},{},{}\n", ++rank, csv_field(names[i]), number_text(report.question.start[i]),
                       report.counts.taken_over[i], shares[i], report.counts.standard_error(i),
                       exact ? fmt::format("{}", *exact) : "");
  }
}

void write_runs_text(std::ostream& out, const RunsReport& report) {
  const auto& names = report.played.scores->names();
  const auto& counts = report.counts;
  write_opening(out, report.played,
                fmt::format("Who takes over, in {} runs of {} strategies", counts.runs, names.size()),
                report.question.dynamics->text(), report.seed);
  std::vector<double> shares;
  for (std::size_t i = 0; i < names.size(); ++i) shares.push_back(counts.share(i));
  const bool exact = expected_share(report, 0).has_value();
  std::vector<std::string> header{"rank", "strategy", "start", "took over", "share %", "standard error"};
  if (exact) header.emplace_back("exact %");
  Table table(header);
  std::size_t rank = 0;
  for (const std::size_t i : ranked(shares)) {
    std::vector<std::string> row{fmt::format("{}", ++rank),
                                 names[i],
                                 number_text(report.question.start[i]),
                                 fmt::format("{}", counts.taken_over[i]),
                                 fmt::format("{:.3f}", 100 * shares[i]),
                                 fmt::format("{:.3f}", 100 * counts.standard_error(i))};
    if (exact) row.push_back(fmt::format("{:.6f}", 100 * *expected_share(report, i)));
    table.add(std::move(row));
  }
  out << table.text() << '\n';
  if (counts.unsettled > 0)
    out << fmt::format("{} runs were not over after {} generations: more --generations let them\n", counts.unsettled,
                       report.question.generations);
  write_closing(out, report.played, signature_of(report));
}

void write_runs_json(std::ostream& out, const RunsReport& report, bool as_file) {
  const auto& names = report.played.scores->names();
  const auto& counts = report.counts;
  write_json_opening(out, report.played, report.question, report.seed, signature_of(report),
                     as_file ? &report.command : nullptr);
  out << fmt::format(",\n  \"runs\": {},\n  \"unsettled\": {},\n  \"generations\": {},\n  \"ranking\": [", counts.runs,
                     counts.unsettled, report.question.generations);
  std::vector<double> shares;
  for (std::size_t i = 0; i < names.size(); ++i) shares.push_back(counts.share(i));
  std::size_t rank = 0;
  for (const std::size_t i : ranked(shares)) {
    const auto exact = expected_share(report, i);
    ++rank;
    out << fmt::format(
        "{}\n    {{\"rank\": {}, \"name\": {}, \"start\": {}, \"taken_over\": {}, \"share\": {}, "
        "\"standard_error\": {}, \"exact\": {}}}",
        rank == 1 ? "" : ",", rank, json_string(names[i]), number_text(report.question.start[i]), counts.taken_over[i],
        shares[i], counts.standard_error(i), exact ? fmt::format("{}", *exact) : "null");
  }
  out << "\n  ]\n}\n";
}

}  // namespace

std::optional<double> expected_share(const RunsReport& report, std::size_t i) {
  const auto& question = report.question;
  const auto& scores = *report.played.scores;
  if (!question.has_rules || scores.size() != 2) return std::nullopt;
  const std::size_t j = 1 - i;
  const TwoTypes<double> payoffs{scores.payoff(i, i), scores.payoff(i, j), scores.payoff(j, i), scores.payoff(j, j)};
  const double all = question.start[0] + question.start[1];
  if (all > 10'000'000) return std::nullopt;
  return fixation_probability(payoffs, static_cast<std::uint64_t>(all), static_cast<std::uint64_t>(question.start[i]),
                              question.rules);
}

void write_fixation(std::ostream& out, const FixationReport& report, Format format) {
  const bool stationary = !report.distribution.empty();
  switch (format) {
    case Format::csv: stationary ? write_distribution_csv(out, report) : write_pairs_csv(out, report); return;
    case Format::json: write_fixation_json(out, report, false); return;
    case Format::text: break;
  }
  const std::size_t n = report.played.scores->size();
  write_opening(out, report.played,
                stationary ? fmt::format("{} strategies under rare mutations", n)
                           : fmt::format("Fixation among {} strategies", n),
                fmt::format("{}, {} individuals", report.question.rules.text(), report.fixation.population),
                report.seed);
  stationary ? write_distribution_text(out, report) : write_pairs_text(out, report);
  write_closing(out, report.played, signature_of(report));
}

void write_fixation_files(const fs::path& folder, const FixationReport& report) {
  write_file(folder / "fixation.csv", [&](std::ostream& out) { write_pairs_csv(out, report); });
  if (!report.distribution.empty())
    write_file(folder / "stationary.csv", [&](std::ostream& out) { write_distribution_csv(out, report); });
  write_file(folder / "summary.json", [&](std::ostream& out) { write_fixation_json(out, report, true); });
}

void write_runs(std::ostream& out, const RunsReport& report, Format format) {
  switch (format) {
    case Format::csv: write_runs_csv(out, report); return;
    case Format::json: write_runs_json(out, report, false); return;
    case Format::text: write_runs_text(out, report); return;
  }
}

void write_runs_files(const fs::path& folder, const RunsReport& report) {
  write_file(folder / "runs.csv", [&](std::ostream& out) { write_runs_csv(out, report); });
  write_file(folder / "summary.json", [&](std::ostream& out) { write_runs_json(out, report, true); });
}

}  // namespace folk::tools
