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

namespace folk::tools {
namespace {

Program train_program() {
  Program program;
  program.name = "mpe-train";
  program.title = "trains players of the particle world and makes their data";
  program.usage = "online|curve|collect|inspect|offline|study [options]";
  program.verbs = {
      {"online", "trains predators, or all agents, by MATD3 or MADDPG", mpe_online},
      {"curve", "draws how training runs went", mpe_curve},
      {"collect", "plays episodes and stores them as an offline data set", mpe_collect},
      {"inspect", "checks a data set and says what is in it", mpe_inspect},
      {"offline", "trains predators from a data set alone: bc, ma-bcq, omar, cql, madt, rmadt, sct", mpe_offline},
      {"study", "the paper's comparison of offline learners, from data to tables", mpe_study}};
  program.summary = "Players of the particle world (simple_tag, simple_world):\n";
  for (const auto& verb : program.verbs) program.summary += fmt::format("  {:<9}{}\n", verb.name, verb.title);
  program.summary += "Each has its own --help.";
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
  return run(argc, argv, train_program(), {}, [](const po::variables_map&, const Common&) -> int {
    throw folk::UsageError("what to do? give online, curve, collect, inspect, offline or study; see mpe-train --help");
  });
}
