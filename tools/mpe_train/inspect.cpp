#include <folk/tools/mpe_train/inspect.h>

#include <folk/tools/mpe_train/data_output.h>
#include <folk/tools/program/program.h>
#include <folk/tools/program/threads_option.h>

#include <folk/games/error.h>
#include <folk/mpe/data/data_figures.h>

#include <algorithm>
#include <iostream>

namespace folk::tools {
namespace {

Program inspect_program() {
  Program program;
  program.name = "mpe-train inspect";
  program.title = "checks a data set and says what is in it";
  program.usage = "DIR [options]";
  program.summary =
      "Reads a data set of the particle world (obs_i, acs_i, rews_i, next_obs_i, dones_i .npy), written by Folk or by\n"
      "others, checks every number of it and says what it is.";
  program.examples = {"mpe-train inspect data/tag-expert", "mpe-train inspect data/tag-expert --scenario simple_tag"};
  auto add = program.options.add_options();
  add("scenario", po::value<std::string>(), "refuse a data set of another: simple_tag, simple_world");
  add("any-length", "take episodes as long as metadata.json says, not of 25 steps alone");
  add("threads", po::value<std::string>(), "threads (default: one a processor)");
  program.arguments.add_options()("folder", po::value<std::string>());
  program.positional.add("folder", 1);
  return program;
}

int inspect(const po::variables_map& values, const Common& common) {
  if (values.count("folder") == 0) throw UsageError("no data set is named: give its folder");
  mpe::DataSetRules rules;
  if (values.count("scenario") != 0) rules.scenario = mpe::Scenario::named(text_option(values, "scenario")).name;
  rules.any_episode_length = values.count("any-length") != 0;
  rules.threads = threads_option(values, common);
  const auto data = mpe::DataSet::open(text_option(values, "folder"), rules);
  const auto figures = mpe::data_figures(data, rules.threads);
  require_recorded(data, figures);
  const auto report = data_report(data, figures);
  if (common.format == Format::json)
    write_json(std::cout, report);
  else
    write_text(std::cout, report);
  return done;
}

}  // namespace

int mpe_inspect(int argc, char** argv) { return run(argc, argv, inspect_program(), {"text", "json"}, inspect); }

}  // namespace folk::tools
