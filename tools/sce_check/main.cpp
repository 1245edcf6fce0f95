// sce-check: is a policy in equilibrium with its opponents, and are its beliefs true?

#include <folk/tools/choices/standard_names.h>
#include <folk/tools/program/progress.h>
#include <folk/tools/sce_check/output.h>

#include <fmt/format.h>

#include <iostream>
#include <memory>

namespace folk::tools {
namespace {

Program sce_check() {
  Program program;
  program.name = "sce-check";
  program.title = "is a policy in equilibrium with its opponents, and are its beliefs true?";
  program.usage = "POLICY [OPPONENT] [options]";
  program.summary =
      "Checks whether POLICY and its opponents are in equilibrium (Nash, subgame perfect, self-confirming) and\n"
      "whether its beliefs are true, with the deviation or the machine that shows it. POLICY is a policy file, sct,\n"
      "any strategy (see ipd-strategies list), @FILE#MACHINE or exec:\"COMMAND\".";
  program.examples = {"sce-check pavlov pavlov --criterion discounted:0.6 --class classics",
                      "sce-check spiteful --opponents spiteful,tit_for_tat --criterion discounted:2/3 --side own",
                      "sce-check pavlov pavlov --payoffs T=4,R=3,P=1,S=0 --criterion discounted:0.9 --noise 0.01",
                      "sce-check tit_for_tat mistrust --criterion discounted:0.9 --from settled",
                      "sce-check sct",
                      "sce-check policy.bin all_d --extract --output report",
                      "sce-check tit_for_tat tit_for_tat --criterion discounted:0.7 --require nash"};
  program.claim = "what was required is refuted";
  add_sce_options(program);
  program.registry = [] { return standard_names(); };
  return program;
}

int check(const po::variables_map& values, const Common& common) {
  const SceQuestion question = sce_question(values, common);
  note_unusual_payoffs(question.game, common);
  if (!flint_available())
    common.note("note: this build has no threshold discount factors, for want of FLINT (libflint-dev)");
  const SceReport report = examine(question, [&](const std::string& stage) {
    return [bar = std::make_shared<ProgressBar>(stage, !common.quiet)](double share) { (*bar)(share); };
  });
  if (question.output) write_files(*question.output, question, report);
  switch (common.format) {
    case Format::text: write_text(std::cout, question, report); break;
    case Format::csv: write_csv(std::cout, question, report); break;
    case Format::json: write_json(std::cout, question, report, false); break;
  }
  if (question.require && !holds(report, *question.require)) {
    std::cout.flush();
    say("sce-check", fmt::format("{} does not hold", *question.require));
    return claim_fails;
  }
  return done;
}

}  // namespace
}  // namespace folk::tools

int main(int argc, char** argv) {
  return folk::tools::run(argc, argv, folk::tools::sce_check(), {"text", "csv", "json"}, folk::tools::check);
}
