#include "mpe_evaluate_output.h"

#include "csv.h"
#include "table.h"

#include <fmt/format.h>
#include <folk/games/text_file.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace folk::tools {
namespace {

using Json = nlohmann::ordered_json;

/// An empty field where there is no number.
std::string csv_number(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? fmt::format("{}", *value) : "";
}

Json json_number(const std::optional<double>& value) { return value && std::isfinite(*value) ? Json(*value) : Json(); }

/// A number for the eye, "-" where there is none.
std::string cell(const std::optional<double>& value, int decimals) {
  return value && std::isfinite(*value) ? fmt::format("{:.{}f}", *value, decimals) : "-";
}

std::string plus_minus(double half) { return std::isfinite(half) ? fmt::format("±{:.2f}", half) : "-"; }

std::string settings_lines(const EvaluationSettings& settings, const Evaluation& evaluation) {
  return fmt::format("{} in {}: {} episodes of {} steps with each prey; rewards of the {}; seed {}{}\n\n",
                     evaluation.predators, settings.scenario.name, settings.plan.episodes,
                     settings.scenario.episode_steps, to_string(settings.scenario.rewards.rule), settings.plan.seed,
                     settings.numpy_seed ? fmt::format("; placed by numpy's seed {}", *settings.numpy_seed) : "");
}

std::string score_table(const Evaluation& evaluation) {
  Table table(
      {"prey", "return", "95 %", "score", "prey's return", "contacts", "caught", "distance", "nearest", "outside"});
  for (const auto& result : evaluation.results) {
    const auto& [episodes, predators, means] = result.summary;
    table.add({result.prey, cell(predators.mean, 2), plus_minus(predators.ci95), cell(result.score, 1),
               cell(means.prey, 2), cell(means.contacts, 2), cell(means.caught_steps, 2), cell(means.distance, 3),
               cell(means.nearest, 3), cell(means.outside_steps, 2)});
  }
  return table.text();
}

std::string reference_table(const Evaluation& evaluation) {
  Table table({"prey", "S_expert", "S_random", "references"});
  for (const auto& [prey, episodes, summary, references, score] : evaluation.results)
    table.add(
        {prey, cell(references.expert, 2), cell(references.random, 2), std::string(to_string(references.source))});
  return table.text();
}

/// What the words of the tables mean, those that were used.
std::string legend(const Evaluation& evaluation) {
  std::string text =
      "\nreturn: the undiscounted sum of one predator's rewards in an episode; 95 %: of its mean (Student's t)\n"
      "score: 100 (S - S_random) / (S_expert - S_random) of the return S\n"
      "contacts: predators touching the prey, added up over the steps; caught: steps with a contact\n"
      "distance: of predators and prey; nearest: of the nearest one; outside: steps with the prey out of [-1, 1]^2\n";
  const auto uses = [&](mpe::ReferenceSource source) {
    return std::any_of(evaluation.results.begin(), evaluation.results.end(),
                       [&](const auto& result) { return result.references.source == source; });
  };
  if (uses(mpe::ReferenceSource::published))
    text += "published: returns of the field's tables, with the released prey\n";
  if (uses(mpe::ReferenceSource::measured))
    text += "measured: the players expert and random with the same prey over the same episodes\n";
  return text;
}

Json json_of(const PreyResult& result, const std::string& predators) {
  const auto& [episodes, returns, means] = result.summary;
  return Json{{"prey", result.prey},
              {"predators", predators},
              {"episodes", episodes},
              {"return",
               {{"mean", returns.mean},
                {"ci95", json_number(returns.ci95)},
                {"sd", json_number(returns.deviation)},
                {"standard_error", json_number(returns.standard_error)}}},
              {"score", json_number(result.score)},
              {"references",
               {{"expert", json_number(result.references.expert)},
                {"random", result.references.random},
                {"source", to_string(result.references.source)}}},
              {"prey_return", means.prey},
              {"contacts", means.contacts},
              {"caught_steps", means.caught_steps},
              {"distance", means.distance},
              {"nearest", means.nearest},
              {"outside_steps", means.outside_steps}};
}

void write_episodes_csv(std::ostream& out, const Evaluation& evaluation) {
  out << "prey,episode,return,prey_return,contacts,caught_steps,distance,nearest,outside_steps\n";
  for (const auto& result : evaluation.results)
    for (std::size_t e = 0; e < result.episodes.size(); ++e) {
      const auto& score = result.episodes[e];
      out << fmt::format("{},{},{},{},{},{},{},{},{}\n", csv_field(result.prey), e, score.predators, score.prey,
                         score.contacts, score.caught_steps, score.distance, score.nearest, score.outside_steps);
    }
}

}  // namespace

void write_text(std::ostream& out, const EvaluationSettings& settings, const Evaluation& evaluation) {
  out << settings_lines(settings, evaluation) << score_table(evaluation) << '\n'
      << reference_table(evaluation) << legend(evaluation);
  for (const auto& note : evaluation.notes) out << "note: " << note << '\n';
  out << fmt::format("signature {:016x}\n", evaluation.signature);
}

void write_csv(std::ostream& out, const EvaluationSettings& settings, const Evaluation& evaluation) {
  out << "scenario,predators,prey,episodes,return,ci95,sd,standard_error,score,reference_expert,reference_random,"
         "reference_source,prey_return,contacts,caught_steps,distance,nearest,outside_steps\n";
  for (const auto& [prey, scores, summary, references, score] : evaluation.results) {
    const auto& [episodes, returns, means] = summary;
    out << fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", settings.scenario.name,
                       csv_field(evaluation.predators), csv_field(prey), episodes, returns.mean,
                       csv_number(returns.ci95), csv_number(returns.deviation), csv_number(returns.standard_error),
                       csv_number(score), csv_number(references.expert), references.random,
                       to_string(references.source), means.prey, means.contacts, means.caught_steps, means.distance,
                       means.nearest, means.outside_steps);
  }
}

void write_json(std::ostream& out, const EvaluationSettings& settings, const Evaluation& evaluation) {
  Json json{{"scenario", settings.scenario.name},
            {"predators", evaluation.predators},
            {"episodes", settings.plan.episodes},
            {"steps", settings.scenario.episode_steps},
            {"reward_rule", to_string(settings.scenario.rewards.rule)},
            {"seed", settings.plan.seed},
            {"numpy_seed", settings.numpy_seed ? Json(*settings.numpy_seed) : Json()},
            {"signature", fmt::format("{:016x}", evaluation.signature)},
            {"notes", evaluation.notes},
            {"results", Json::array()}};
  for (const auto& result : evaluation.results) json["results"].push_back(json_of(result, evaluation.predators));
  out << json.dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
}

void write_files(const std::filesystem::path& folder, const EvaluationSettings& settings,
                 const Evaluation& evaluation) {
  write_file(folder / "results.csv", [&](std::ostream& out) { write_csv(out, settings, evaluation); });
  write_file(folder / "results.json", [&](std::ostream& out) { write_json(out, settings, evaluation); });
  write_file(folder / "episodes.csv", [&](std::ostream& out) { write_episodes_csv(out, evaluation); });
}

}  // namespace folk::tools
