#include <folk/tools/mpe_evaluate/output.h>

#include <folk/tools/program/csv.h>
#include <folk/tools/program/table.h>

#include <fmt/format.h>
#include <folk/games/text_file.h>
#include <folk/games/utf8.h>

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
                     visible_text(evaluation.predators), settings.scenario.name, settings.plan.episodes,
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
  for (const auto& [prey, episodes, summary, references, score, transformer] : evaluation.results)
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

/// "0.873 ±0.012"
std::string measured(const mpe::Estimate& estimate, int decimals) {
  return std::isfinite(estimate.ci95)
             ? fmt::format("{:.{}f} ±{:.{}f}", estimate.mean, decimals, estimate.ci95, decimals)
             : fmt::format("{:.{}f}", estimate.mean, decimals);
}

/// What is said of a transformer's beliefs and of the returns it was asked for.
std::string transformer_tables(const EvaluationSettings& settings, const Evaluation& evaluation) {
  std::string text;
  if (settings.beliefs) {
    std::vector<std::string> header{"prey", "target"};
    for (const double radius : mpe::belief_radii) header.push_back(fmt::format("within {:.0f} %", 100 * radius));
    for (const double radius : mpe::absolute_radii) header.push_back(fmt::format("within {}", radius));
    header.push_back("distance");
    Table table(header);
    for (const auto& result : evaluation.results) {
      const auto& transformer = *result.transformer;
      std::vector<std::string> row{result.prey, fmt::format("{:g}", transformer.target)};
      for (const auto& right : transformer.beliefs->right) row.push_back(measured(right, 3));
      for (const auto& within : transformer.beliefs->within) row.push_back(measured(within, 3));
      row.push_back(measured(transformer.beliefs->distance, 4));
      table.add(row);
    }
    text += fmt::format(
        "\n{}\nwithin r %: share of steps with |belief - action| < r max(|action|, {}); within 0.1, ...: with a "
        "distance below it\n",
        table.text(), mpe::belief_floor);
  }
  if (settings.forced_beliefs) {
    Table table({"prey", "belief", "return", "difference", "actions change by"});
    for (const auto& result : evaluation.results)
      for (const auto& forced : result.transformer->forced)
        table.add({result.prey,
                   forced.forcing == mpe::BeliefForcing::none ? "own" : std::string(to_string(forced.forcing)),
                   measured(forced.predators, 2), measured(forced.difference, 2), measured(forced.change, 4)});
    text += fmt::format(
        "\n{}\nbelief: what stands in the belief token: the own belief, what the prey will do, what it will do in "
        "another episode,\nor zero; difference: of the return from that on own beliefs, episode by episode\n",
        table.text());
  }
  if (!settings.targets.empty()) {
    Table table({"prey", "asked", "return", settings.beliefs ? "within 10 %" : "", ""});
    for (const auto& result : evaluation.results)
      for (const auto& row : result.transformer->targets)
        table.add({result.prey, fmt::format("{:g}", row.target), measured(row.predators, 2),
                   settings.beliefs ? measured(row.beliefs->right[mpe::paper_radius], 3) : "",
                   row.target == result.transformer->target ? "played" : ""});
    text +=
        fmt::format("\n{}\nasked: the return asked for, over the {} episodes of seed {}; the best is played above\n",
                    table.text(), settings.plan.episodes, settings.selection_seed);
  }
  return text;
}

Json json_of(const mpe::Estimate& estimate) { return {{"mean", estimate.mean}, {"ci95", json_number(estimate.ci95)}}; }

Json json_of(const mpe::BeliefSummary& beliefs) {
  Json json;
  for (std::size_t r = 0; r < mpe::belief_radii.size(); ++r)
    json["right"].push_back({{"radius", mpe::belief_radii[r]},
                             {"mean", beliefs.right[r].mean},
                             {"ci95", json_number(beliefs.right[r].ci95)}});
  for (std::size_t r = 0; r < mpe::absolute_radii.size(); ++r)
    json["within"].push_back({{"radius", mpe::absolute_radii[r]},
                              {"mean", beliefs.within[r].mean},
                              {"ci95", json_number(beliefs.within[r].ci95)}});
  json["distance"] = json_of(beliefs.distance);
  return json;
}

Json json_of(const TransformerResult& transformer) {
  Json json{{"target", transformer.target}};
  if (transformer.beliefs) json["beliefs"] = json_of(*transformer.beliefs);
  for (const auto& row : transformer.targets) {
    Json asked{{"target", row.target}, {"return", json_of(row.predators)}};
    if (row.beliefs) asked["beliefs"] = json_of(*row.beliefs);
    json["asked"].push_back(asked);
  }
  for (const auto& forced : transformer.forced)
    json["forced"].push_back({{"belief", to_string(forced.forcing)},
                              {"return", json_of(forced.predators)},
                              {"difference", json_of(forced.difference)},
                              {"change", json_of(forced.change)}});
  return json;
}

Json json_of(const PreyResult& result, const std::string& predators) {
  const auto& [episodes, returns, means] = result.summary;
  Json json{{"prey", result.prey},
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
  if (result.transformer) json["transformer"] = json_of(*result.transformer);
  return json;
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
  out << transformer_tables(settings, evaluation);
  for (const auto& note : evaluation.notes) out << visible_line("note: " + note);
  out << fmt::format("signature {:016x}\n", evaluation.signature);
}

void write_csv(std::ostream& out, const EvaluationSettings& settings, const Evaluation& evaluation) {
  out << "scenario,predators,prey,episodes,return,ci95,sd,standard_error,score,reference_expert,reference_random,"
         "reference_source,prey_return,contacts,caught_steps,distance,nearest,outside_steps\n";
  for (const auto& [prey, scores, summary, references, score, transformer] : evaluation.results) {
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
  if (!settings.targets.empty()) json["selection_seed"] = settings.selection_seed;
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
