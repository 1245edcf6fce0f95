#include <folk/games/criterion.h>
#include <folk/games/error.h>
#include <folk/games/text_file.h>
#include <folk/mpe/study/study_tables.h>

#include <fmt/format.h>
#include <boost/math/distributions/students_t.hpp>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

namespace folk::mpe {
namespace {

namespace fs = std::filesystem;

/// The returns that count as 100 and 0, for one data prey and scenario.
std::optional<References> references_of(const std::map<std::string, StudyRecord>& records, const std::string& data_prey,
                                        const std::string& scenario) {
  if (data_prey == "released") return published_references(Scenario::named(scenario));
  const auto against_it = [&](const StudyJob& job) -> std::optional<double> {
    const auto found = records.find(job.name());
    if (found == records.end()) return std::nullopt;
    for (const auto& prey : found->second.preys)
      if (prey.prey == data_prey) return prey.predators.mean;
    return std::nullopt;
  };
  const auto expert = against_it({data_prey, scenario, "expert", "matd3", 1});
  const auto random = against_it({data_prey, scenario, "none", "random_play", 1});
  if (!expert || !random || *expert == *random) return std::nullopt;
  return References{*expert, *random, ReferenceSource::measured};
}

/// A difference of returns in units of the score.
Mean in_units(const Mean& difference, const References& references) {
  const double unit = 100 / (*references.expert - references.random);
  return {difference.mean * unit, difference.ci95 * std::abs(unit)};
}

/// A return's mean and interval as a normalised score.
Mean normalised(const Mean& predators, const References& references) {
  return in_units({predators.mean - references.random, predators.ci95}, references);
}

/// Half of Student's 95 % interval in units of the mean's standard error.
double student(double freedom) { return boost::math::quantile(boost::math::students_t(freedom), 0.975); }

/// The mean of one record's returns less another's against the same prey, batch by batch; nothing where one has none.
std::optional<Mean> batch_difference(const PreyRecord* one, const PreyRecord* other) {
  if (one == nullptr || other == nullptr || one->batches.size() != report_batches ||
      other->batches.size() != report_batches)
    return std::nullopt;
  constexpr double count = report_batches;
  double mean = 0, squares = 0;
  for (std::size_t b = 0; b < report_batches; ++b) mean += (one->batches[b] - other->batches[b]) / count;
  for (std::size_t b = 0; b < report_batches; ++b) {
    const double apart = one->batches[b] - other->batches[b] - mean;
    squares += apart * apart;
  }
  return Mean{mean, student(count - 1) * std::sqrt(squares / (count - 1) / count)};
}

/// The records of one place in the tables, seed after seed.
using Group = std::vector<const StudyRecord*>;

const PreyRecord* against(const StudyRecord& record, const std::string& prey) {
  for (const auto& one : record.preys)
    if (one.prey == prey) return &one;
  return nullptr;
}

/// The cell over a group's seeds of what `part` finds in each; nothing where it finds nothing.
template <class Part>
std::optional<Cell> cell_over(const Group& group, const std::string& prey, Part&& part) {
  std::vector<Mean> seeds;
  for (const auto* record : group)
    if (const auto* one = against(*record, prey))
      if (const std::optional<Mean> mean = part(*one)) seeds.push_back(*mean);
  if (seeds.empty()) return std::nullopt;
  return cell_of(seeds);
}

class Tables {
public:
  Tables(const std::map<std::string, StudyRecord>& records, const StudySettings& settings, const std::string& data_prey,
         const PaperTables& paper)
      : records_(records),
        paper_(paper) {
    tables_.data_prey = data_prey;
    tables_.budget = to_string(settings.budget);
    std::vector<StudyJob> places;  // jobs but for their seeds, in the order of their first one
    for (auto job : study_jobs(settings)) {
      if (job.data_prey != data_prey) continue;
      if (const auto found = records.find(job.name()); found != records.end()) {
        job.seed = 0;
        groups_[job.name()].push_back(&found->second);
        if (const auto& record = found->second; !record.diverged.empty())
          tables_.diverged.push_back(fmt::format("{}: {}", record.job.name(), excerpt(record.diverged, 1000)));
      }
      job.seed = 0;
      if (std::find(places.begin(), places.end(), job) == places.end()) places.push_back(job);
    }
    for (const auto& place : places) {
      add(place);
      if (place.learner == "sct") add_pairs(place, places);
    }
  }

  StudyTables take() && { return std::move(tables_); }

private:
  void add(const StudyJob& place) {
    const auto references = references_of(records_, place.data_prey, place.scenario);
    const Group group = groups_[place.name()];
    const auto score = [&](const Mean& predators) -> std::optional<Mean> {
      if (!references) return std::nullopt;
      return normalised(predators, *references);
    };
    const auto difference = [&](const Mean& returns) -> std::optional<Mean> {
      if (!references) return std::nullopt;
      return in_units(returns, *references);
    };
    for (const auto& prey : table_preys()) {
      const std::string key = fmt::format("{},{},{},{}", place.scenario, place.level, place.learner, prey);
      ScoreRow row{place.scenario, place.level, place.learner, prey, {}, {}, {}, {}, {}};
      row.score = cell_over(group, prey, [&](const PreyRecord& one) { return score(one.predators); });
      row.at_data_target = cell_over(group, prey, [&](const PreyRecord& one) -> std::optional<Mean> {
        return one.data_target_predators ? score(*one.data_target_predators) : std::nullopt;
      });
      row.at_own_target = cell_over(group, prey, [&](const PreyRecord& one) -> std::optional<Mean> {
        return one.own_target_predators ? score(*one.own_target_predators) : std::nullopt;
      });
      const bool papers = place.data_prey == "released";
      if (const auto found = paper_.scores.find(key); papers && found != paper_.scores.end()) {
        row.paper = found->second.score;
        row.paper_sd = found->second.sd;
      }
      (place.learns() ? tables_.scores : tables_.players).push_back(row);
      if (place.transformer() && place.learner != "madt") add_beliefs(place, group, prey, key);
    }
    for (const auto& [p, prey] : blend_preys()) {
      BlendRow row{place.scenario, place.level, place.learner, p, {}};
      row.score = cell_over(group, prey, [&](const PreyRecord& one) { return score(one.predators); });
      tables_.blends.push_back(row);
    }
    if (place.transformer())
      for (const auto& prey : table_preys())
        for (const double target : target_grid(place)) add_asked(place, group, prey, target, score);
    if (place.learner.starts_with("sct"))
      for (const auto& prey : table_preys()) add_forced(place, group, prey, score, difference);
    if (!group.empty() && place.learns())
      tables_.data_returns[fmt::format("{}-{}", place.scenario, place.level)] = group.front()->data_return;
    if (const auto cell = cell_over(group, place.data_prey,
                                    [](const PreyRecord& one) -> std::optional<Mean> { return one.predators; }))
      tables_.data_prey_returns[fmt::format("{}-{}-{}", place.scenario, place.level, place.learner)] = *cell;
  }

  /// `sct` against every other learner of its data.
  void add_pairs(const StudyJob& sct, const std::vector<StudyJob>& places) {
    const auto references = references_of(records_, sct.data_prey, sct.scenario);
    for (const auto& prey : table_preys())
      for (const auto& learner : study_learners()) {
        auto other = sct;
        other.learner = learner;
        if (other == sct || std::find(places.begin(), places.end(), other) == places.end()) continue;
        std::vector<Mean> seeds;
        for (const auto* one : groups_[sct.name()])
          for (const auto* two : groups_[other.name()]) {
            if (!references || one->job.seed != two->job.seed) continue;
            if (const auto difference = batch_difference(against(*one, prey), against(*two, prey)))
              seeds.push_back(in_units(*difference, *references));
          }
        PairedRow row{sct.scenario, sct.level, prey, learner, {}};
        if (!seeds.empty()) row.difference = cell_of(seeds);
        tables_.paired.push_back(row);
      }
  }

  void add_beliefs(const StudyJob& place, const Group& group, const std::string& prey, const std::string& key) {
    AccuracyRow row{place.scenario, place.level, place.learner, prey, {}, {}, {}, {}, {}};
    const auto over = [&](auto&& part) {
      return cell_over(group, prey, [&](const PreyRecord& one) -> std::optional<Mean> {
        return one.beliefs ? std::optional<Mean>(part(*one.beliefs)) : std::nullopt;
      });
    };
    for (std::size_t r = 0; r < belief_radii.size(); ++r)
      row.right.push_back(over([r](const RightBeliefs& beliefs) { return beliefs.right[r]; }));
    row.accuracy = row.right[paper_radius];
    for (std::size_t r = 0; r < absolute_radii.size(); ++r)
      row.within.push_back(over([r](const RightBeliefs& beliefs) { return beliefs.within[r]; }));
    row.distance = over([](const RightBeliefs& beliefs) { return beliefs.distance; });
    if (const auto found = paper_.accuracies.find(key);
        place.data_prey == "released" && found != paper_.accuracies.end())
      row.paper = found->second;
    tables_.accuracies.push_back(row);
  }

  template <class Score>
  void add_asked(const StudyJob& place, const Group& group, const std::string& prey, double target, Score&& score) {
    const auto of_target = [&](const PreyRecord& one) -> const AskedReturn* {
      for (const auto& asked : one.asked)
        if (asked.target == target) return &asked;
      return nullptr;
    };
    AskedRow row{place.scenario, place.level, place.learner, prey, target, {}, {}};
    row.score = cell_over(group, prey, [&](const PreyRecord& one) -> std::optional<Mean> {
      const auto* asked = of_target(one);
      return asked != nullptr ? score(asked->predators) : std::nullopt;
    });
    row.accuracy = cell_over(group, prey, [&](const PreyRecord& one) -> std::optional<Mean> {
      const auto* asked = of_target(one);
      return asked != nullptr && asked->beliefs ? std::optional<Mean>(asked->beliefs->right[paper_radius])
                                                : std::nullopt;
    });
    tables_.asked.push_back(row);
  }

  template <class Score, class Difference>
  void add_forced(const StudyJob& place, const Group& group, const std::string& prey, Score&& score,
                  Difference&& difference) {
    const auto forced_by = [](const PreyRecord& one, BeliefForcing forcing) -> const ForcedBelief* {
      for (const auto& forced : one.forced)
        if (forced.forcing == to_string(forcing)) return &forced;
      return nullptr;
    };
    for (const auto forcing : belief_forcings) {
      ForcedRow row{place.scenario, place.level, place.learner, prey, std::string(to_string(forcing)), {}, {}, {}};
      row.score = cell_over(group, prey, [&](const PreyRecord& one) -> std::optional<Mean> {
        const auto* forced = forced_by(one, forcing);
        return forced != nullptr ? score(forced->predators) : std::nullopt;
      });
      row.difference = cell_over(group, prey, [&](const PreyRecord& one) -> std::optional<Mean> {
        const auto* forced = forced_by(one, forcing);
        return forced != nullptr ? difference(forced->difference) : std::nullopt;
      });
      row.change = cell_over(group, prey, [&](const PreyRecord& one) -> std::optional<Mean> {
        const auto* forced = forced_by(one, forcing);
        return forced != nullptr ? std::optional<Mean>(forced->change) : std::nullopt;
      });
      tables_.forced.push_back(row);
    }
  }

  const std::map<std::string, StudyRecord>& records_;
  const PaperTables& paper_;
  std::map<std::string, Group> groups_;
  StudyTables tables_;
};

/// Rows of a small CSV without quotes: fields by line; the header is checked.
std::vector<std::vector<std::string>> rows_of(const fs::path& file, const std::string& header) {
  std::istringstream lines(read_text_file(file));
  std::string line;
  std::vector<std::vector<std::string>> rows;
  const auto columns = static_cast<std::size_t>(std::count(header.begin(), header.end(), ',')) + 1;
  for (std::size_t number = 1; std::getline(lines, line); ++number) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (number == 1) {
      if (line != header)
        throw InputFileError(fmt::format("{}:1: expected the header {}", excerpt(file.string(), 1000), header));
      continue;
    }
    std::vector<std::string> fields;
    std::istringstream parts(line);
    for (std::string field; std::getline(parts, field, ',');) fields.push_back(field);
    if (fields.size() != columns)
      throw InputFileError(
          fmt::format("{}:{}: {} fields: expected {}", excerpt(file.string(), 1000), number, fields.size(), columns));
    rows.push_back(std::move(fields));
  }
  return rows;
}

double number_of(const fs::path& file, const std::string& text) {
  try {
    return parse_number(text, "a number", -1e6, 1e6);
  } catch (const UsageError& error) {
    throw InputFileError(fmt::format("{}: {}", excerpt(file.string(), 1000), error.what()));
  }
}

/// The paper's words for learners and preys in those of the study.
std::string key_of(const std::vector<std::string>& fields) {
  std::string learner = fields[2];
  std::transform(learner.begin(), learner.end(), learner.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  static const std::map<std::string, std::string> preys{
      {"matd3", "released"}, {"random", "random(program)"}, {"blend", "blend(0.5)"}};
  const auto found = preys.find(fields[3]);
  return fmt::format("{},{},{},{}", fields[0], fields[1], learner, found == preys.end() ? fields[3] : found->second);
}

}  // namespace

Cell cell_of(std::span<const Mean> seeds) {
  Cell cell;
  cell.seeds = seeds.size();
  const double count = static_cast<double>(seeds.size());
  double episodes = 0;
  for (const auto& seed : seeds) {
    cell.mean += seed.mean / count;
    episodes += seed.ci95 * seed.ci95;
  }
  cell.ci95 = std::sqrt(episodes) / count;
  if (seeds.size() < 2) return cell;
  double squares = 0;
  for (const auto& seed : seeds) squares += (seed.mean - cell.mean) * (seed.mean - cell.mean);
  const double error = std::sqrt(squares / (count - 1) / count);
  cell.ci95 = std::max(cell.ci95, error * student(count - 1));
  return cell;
}

PaperTables read_paper_tables(const fs::path& players) {
  PaperTables paper;
  const fs::path scores = players / "paper_scores.csv";
  for (const auto& fields : rows_of(scores, "scenario,level,learner,prey,score,sd"))
    paper.scores[key_of(fields)] = {number_of(scores, fields[4]), number_of(scores, fields[5])};
  const fs::path accuracies = players / "paper_accuracy.csv";
  for (const auto& fields : rows_of(accuracies, "scenario,level,learner,prey,accuracy"))
    paper.accuracies[key_of(fields)] = number_of(accuracies, fields[4]);
  return paper;
}

StudyTables study_tables(const std::map<std::string, StudyRecord>& records, const StudySettings& settings,
                         const std::string& data_prey, const PaperTables& paper) {
  return Tables(records, settings, data_prey, paper).take();
}

}  // namespace folk::mpe
