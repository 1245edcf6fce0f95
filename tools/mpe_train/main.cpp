// mpe-train: trains players of the particle world and makes their data, a program for each.

#include <folk/tools/mpe_train/collect.h>
#include <folk/tools/mpe_train/curve.h>
#include <folk/tools/mpe_train/inspect.h>
#include <folk/tools/mpe_train/offline.h>
#include <folk/tools/mpe_train/online.h>
#include <folk/tools/mpe_train/study.h>
#include <folk/tools/program/program.h>

#include <fmt/format.h>
#include <folk/games/error.h>

#include <string>
#include <string_view>

namespace folk::tools {
namespace {

Program train_program() {
  Program program;
  program.name = "mpe-train";
  program.usage = "online|curve|collect|inspect|offline|study [options]";
  program.summary =
      "Players of the particle world (simple_tag, simple_world):\n"
      "  online   trains predators, or all agents, by MATD3 or MADDPG\n"
      "  curve    draws how training runs went\n"
      "  collect  plays episodes and stores them as an offline data set\n"
      "  inspect  checks a data set and says what is in it\n"
      "  offline  trains predators from a data set alone: bc, ma-bcq, omar, cql, madt, rmadt, sct\n"
      "  study    the paper's comparison of offline learners, from data to tables\n"
      "Each has its own --help.";
  program.examples = {"mpe-train online --scenario simple_tag --seed 1 --output predators.safetensors",
                      "mpe-train curve run-1.csv run-2.csv --output runs.svg",
                      "mpe-train collect --scenario simple_tag --level expert --output expert-data",
                      "mpe-train inspect expert-data",
                      "mpe-train offline --learner sct --data expert-data --output sct.safetensors"};
  return program;
}

}  // namespace
}  // namespace folk::tools

int main(int argc, char** argv) {
  using namespace folk::tools;
  const std::string_view verb = argc > 1 ? argv[1] : "";
  if (verb == "online") return mpe_online(argc - 1, argv + 1);
  if (verb == "curve") return mpe_curve(argc - 1, argv + 1);
  if (verb == "collect") return mpe_collect(argc - 1, argv + 1);
  if (verb == "inspect") return mpe_inspect(argc - 1, argv + 1);
  if (verb == "offline") return mpe_offline(argc - 1, argv + 1);
  if (verb == "study") return mpe_study(argc - 1, argv + 1);
  return run(argc, argv, train_program(), {}, [](const po::variables_map&, const Common&) -> int {
    throw folk::UsageError("what to do? give online, curve, collect, inspect, offline or study; see mpe-train --help");
  });
}
