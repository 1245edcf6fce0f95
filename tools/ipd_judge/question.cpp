#include <folk/tools/ipd_judge/question.h>

#include <folk/tools/choices/play_options.h>
#include <folk/tools/choices/standard_names.h>
#include <folk/tools/program/output_folder.h>
#include <folk/tools/program/standard_input.h>
#include <folk/tools/program/threads_option.h>

#include <fmt/format.h>
#include <folk/games/error.h>
#include <folk/games/rational.h>
#include <folk/strategies/names.h>

#include <algorithm>

namespace folk::tools {
namespace {

std::vector<double> slips_of(const po::variables_map& values) {
  if (values.count("slips") == 0) return usual_slips();
  std::vector<double> slips;
  for (const auto& text : split_list(text_option(values, "slips")))
    slips.push_back(parse_number(text, "--slips", 0, 0.5));
  try {
    check_slips(slips);
  } catch (const UsageError& error) {
    throw UsageError(fmt::format("--slips: {}", error.what()));
  }
  return slips;
}

/// Who is named, less those that nobody can judge by.
OpponentPrior prior_of(const Registry& registry, const std::string& spec, const char* option, JudgeQuestion& question) {
  OpponentPrior prior = read_weighted_roster(registry, spec, question.payoffs);
  for (auto& name : leave_out_unpredictable(prior))
    if (std::find(question.left_out.begin(), question.left_out.end(), name) == question.left_out.end())
      question.left_out.push_back(std::move(name));
  if (prior.known.empty() && prior.classes.empty())
    throw UsageError(
        fmt::format("--{} {}: nobody is left, as how likely the moves of players are that draw random "
                    "numbers and are no machines is not known",
                    option, excerpt(spec)));
  return prior;
}

}  // namespace

void add_judge_options(Program& program) {
  auto add = program.options.add_options();
  const auto text = [] { return po::value<std::string>(); };
  add("strategies", text()->default_value("classics"),
      "SPEC of who the player may be; its items may have weights, 3*ITEM, and memory(X,Y) is all of a class");
  add("opponents", text(), "SPEC of whom it may have met (default: the strategies)");
  add("slips", text(), "comma list of slip rates to weigh, each from 0 to less than 0.5 (default: 0 to 0.3)");
  add_game_options(program.options);
  add_play_options(program.options);
  add("show", text(), "rows of each table of text (default 10)");
  add("threads", text(), "threads (default: one a processor); the results do not depend on it");
  add("output", text(), "folder for report.html and report.json");
  program.arguments.add_options()("file", po::value<std::vector<std::string>>());
  program.positional.add("file", 1);
}

JudgeQuestion judge_question(const po::variables_map& values, const Common& common) {
  const auto files =
      values.count("file") != 0 ? values["file"].as<std::vector<std::string>>() : std::vector<std::string>{};
  if (files.empty()) throw UsageError("no record named: try ipd-judge play.csv, with columns match,round,own,theirs");
  JudgeQuestion question;
  question.file = files.front();
  question.game = chosen_game(values);
  question.payoffs = question.game.payoffs;
  question.slips = slips_of(values);
  question.shown = whole_option(values, "show", 10, 1, 1'000'000);
  question.threads = threads_option(values, common);
  question.command = common.command;
  const Registry registry = standard_names(chosen_play_options(values));
  question.players_spec = text_option(values, "strategies");
  question.opponents_spec = text_option(values, "opponents", question.players_spec);
  question.weighted = has_weights(question.players_spec) || has_weights(question.opponents_spec);
  question.players = prior_of(registry, question.players_spec, "strategies", question);
  question.opponents = prior_of(registry, question.opponents_spec, "opponents", question);
  question.play = read_recorded_play(read_file_or_input(question.file, "FILE -"), question.file, question.game.actions);
  question.output = output_folder(values);
  return question;
}

}  // namespace folk::tools
