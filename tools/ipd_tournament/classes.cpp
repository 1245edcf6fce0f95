#include <folk/tools/choices/criterion_option.h>
#include <folk/tools/choices/game_option.h>
#include <folk/tools/choices/play_options.h>
#include <folk/tools/choices/standard_names.h>
#include <folk/tools/choices/whole_class.h>
#include <folk/tools/ipd_tournament/class_output.h>
#include <folk/tools/ipd_tournament/classes.h>
#include <folk/tools/program/launch.h>
#include <folk/tools/program/output_folder.h>
#include <folk/tools/program/piece_file.h>
#include <folk/tools/program/progress.h>
#include <folk/tools/program/threads_option.h>

#include <fmt/format.h>
#include <folk/games/error.h>
#include <folk/strategies/registry.h>

#include <algorithm>
#include <functional>
#include <initializer_list>
#include <iostream>
#include <optional>
#include <utility>

namespace folk::tools {
namespace {

/// Refuses options that say nothing of such a run.
void refuse(const po::variables_map& values, std::initializer_list<const char*> names, const std::string& run) {
  for (const char* name : names)
    if (values.count(name) != 0) throw UsageError(fmt::format("--{} does not go with {}", name, run));
  if (parse_number(text_option(values, "noise"), "--noise", 0, 1) > 0)
    throw UsageError(fmt::format("--noise does not go with {}: members are told apart by exact play", run));
}

}  // namespace

std::optional<MemoryClass> whole_class(const po::variables_map& values) {
  const std::string spec = text_option(values, "strategies");
  if (values.count("by-behaviour") == 0) return unlisted_class(spec);
  const auto members = named_class(spec);
  if (!members) throw UsageError("--by-behaviour is for a complete class alone: --strategies 'memory(X,Y)'");
  return members;
}

int rank_class(const MemoryClass& members, const po::variables_map& values, const Common& common) {
  if (members.entries() > most_ranked_entries)
    throw UsageError(
        fmt::format("{} has {} members: a class is ranked as a whole up to X + Y = 4; --class '{}' scores "
                    "entrants against all of them",
                    members.name(), members.size_text(), members.name()));
  refuse(values, {"include", "exclude", "invasion", "sub-rosters", "repetitions", "plot"},
         fmt::format("the ranking of all of {}", members.name()));
  const ChosenGame game = chosen_game(values);
  ClassSettings settings;
  settings.payoffs = game.payoffs;
  settings.criterion = chosen_criterion(values);
  settings.self_play = values.count("no-self-play") == 0;
  settings.threads = threads_option(values, common);
  const auto folder = output_folder(values);
  note_unusual_payoffs(game, common);
  const bool by_behaviour = values.count("by-behaviour") != 0;
  std::optional<ClassTournament> ranked;
  ClassLabels labels{game.title, common.command};
  run_kept(values, [&](const auto& ended) {
    ProgressBar bar(fmt::format("ranking {} strategies", members.size_text()), !common.quiet);
    const Progress progress(std::ref(bar), ended);
    ranked = play_class(members, settings, progress.part(0, by_behaviour ? 0.5 : 1), crew());
    if (by_behaviour && crew().first())
      labels.behaviours = behaviours_of(members, settings.threads, progress.part(0.5, 1));
  });
  if (!crew().first()) return done;
  const ClassTournament& tournament = *ranked;
  if (folder) write_class_files(*folder, tournament, labels);
  switch (common.format) {
    case Format::text: write_class_text(std::cout, tournament, labels); break;
    case Format::csv: write_class_csv(std::cout, tournament, labels); break;
    case Format::json: write_class_json(std::cout, tournament, labels, false); break;
  }
  return done;
}

ClassQuestion class_question(const po::variables_map& values, const Common& common) {
  refuse(values,
         {"include", "exclude", "invasion", "sub-rosters", "repetitions", "plot", "no-self-play", "by-behaviour"},
         "--class");
  if (values.count("strategies") != 0 && !values["strategies"].defaulted())
    throw UsageError("--strategies does not go with --class: who plays against the class is --entrants SPEC");
  const std::string name = text_option(values, "class");
  const auto members = MemoryClass::parse(name);
  if (!members) throw UsageError(fmt::format("--class '{}': expected memory(X,Y)", excerpt(name)));
  ClassQuestion question{chosen_game(values), *members, {}, {}};
  question.settings.payoffs = question.game.payoffs;
  question.settings.criterion = chosen_criterion(values);
  question.settings.most_leaves =
      whole_option(values, "most-kinds", question.settings.most_leaves, 1, std::uint64_t{1} << 62);
  question.settings.threads = threads_option(values, common);
  const Registry registry = standard_names(chosen_play_options(values));
  question.entrants = registry.roster(text_option(values, "entrants", "classics"), question.game.payoffs);
  for (const Strategy& entrant : question.entrants)
    if (!entrant.machine || !entrant.machine->deterministic())
      throw UsageError(fmt::format("{} is {}: a class is gone through with strategies that are machines without chance",
                                   excerpt(entrant.name), entrant.machine ? "random" : "no machine"));
  for (const Strategy& entrant : question.entrants)
    if (!entrant.machine->finite() && !question.settings.criterion.is_finite())
      throw UsageError(fmt::format("{} has infinitely many states: against a class it needs an end, --rounds N",
                                   excerpt(entrant.name)));
  return question;
}

ClassScores scored(const ClassQuestion& question, const Progress& progress) {
  ClassScores scores{question.members, question.settings};
  const auto all = static_cast<double>(question.entrants.size());
  for (std::size_t i = 0; i < question.entrants.size(); ++i) {
    const Strategy& entrant = question.entrants[i];
    const Progress part = progress.part(static_cast<double>(i) / all, static_cast<double>(i + 1) / all);
    try {
      scores.entrants.push_back(
          {entrant.name, score_against(question.members, *entrant.machine, question.settings, part, crew())});
    } catch (const TooManyKinds& error) {
      scores.left_out.emplace_back(entrant.name, error.what());
    } catch (const UsageError& error) {
      throw UsageError(fmt::format("{}: {}", excerpt(entrant.name), error.what()));
    }
  }
  if (scores.entrants.empty())
    throw TooManyKinds(fmt::format("{}: {}", excerpt(scores.left_out[0].first), scores.left_out[0].second));
  std::stable_sort(scores.entrants.begin(), scores.entrants.end(),
                   [](const auto& a, const auto& b) { return a.score.mean > b.score.mean; });
  return scores;
}

int score_entrants(const po::variables_map& values, const Common& common) {
  const ClassQuestion question = class_question(values, common);
  const auto folder = output_folder(values);
  note_unusual_payoffs(question.game, common);
  std::optional<ClassScores> found;
  run_kept(values, [&](const auto& ended) {
    ProgressBar bar(fmt::format("{} strategies against {}", question.entrants.size(), question.members.name()),
                    !common.quiet);
    found = scored(question, Progress(std::ref(bar), ended));
  });
  if (!crew().first()) return done;
  const ClassScores& scores = *found;
  const ClassLabels labels{question.game.title, common.command};
  if (folder) write_scores_files(*folder, scores, labels);
  switch (common.format) {
    case Format::text: write_scores_text(std::cout, scores, labels); break;
    case Format::csv: write_scores_csv(std::cout, scores); break;
    case Format::json: write_scores_json(std::cout, scores, labels); break;
  }
  return done;
}

}  // namespace folk::tools
