// ipd-judge: who may have played what was recorded, how well, and on which beliefs?

#include <folk/tools/choices/standard_names.h>
#include <folk/tools/ipd_judge/output.h>
#include <folk/tools/program/progress.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <functional>
#include <iostream>

namespace folk::tools {
namespace {

Program ipd_judge() {
  Program program;
  program.name = "ipd-judge";
  program.title = "who may have played what was recorded, how well, and on which beliefs?";
  program.usage = "FILE.csv [options]";
  program.summary =
      "Judges recorded matches of one player: people, language models, any program. FILE.csv has the columns\n"
      "match,round,own,theirs and perhaps belief, P(their C) as it was stated before the round; - is the standard\n"
      "input. Says which strategies agree with the play, which is the likeliest when moves slip, how much more a\n"
      "best reply would have earned, and whether the play can be self-confirming.";
  program.examples = {
      "ipd-judge examples/language_model.csv",
      "ipd-judge examples/language_model.csv --strategies 'classics,1*memory(3,3)' --opponents classics",
      "ipd-judge examples/language_model.csv --slips 0,0.01,0.05 --format json",
      "ipd-judge examples/language_model.csv --output report"};
  add_judge_options(program);
  program.registry = [] { return standard_names(); };
  return program;
}

int judge(const po::variables_map& values, const Common& common) {
  const JudgeQuestion question = judge_question(values, common);
  note_unusual_payoffs(question.game, common);
  if (!question.play.ignored_columns.empty())
    common.note(fmt::format("ignored columns: {}", fmt::join(question.play.ignored_columns, ", ")));
  if (!question.left_out.empty())
    common.note(fmt::format("left out, as they draw random numbers and are no machines: {}",
                            fmt::join(question.left_out, ", ")));
  const Judgement found = [&] {
    ProgressBar progress("judging", !common.quiet);
    return judge_play(question, std::ref(progress));
  }();
  if (question.output) write_files(*question.output, question, found);
  switch (common.format) {
    case Format::text: write_text(std::cout, question, found); break;
    case Format::csv: write_csv(std::cout, question, found); break;
    case Format::json: write_json(std::cout, question, found); break;
  }
  return done;
}

}  // namespace
}  // namespace folk::tools

int main(int argc, char** argv) {
  return folk::tools::run(argc, argv, folk::tools::ipd_judge(), {"text", "csv", "json"}, folk::tools::judge);
}
