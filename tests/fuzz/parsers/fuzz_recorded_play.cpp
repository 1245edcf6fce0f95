// read_recorded_play: whatever is read is written and read back as the same, and can be judged.

#include <folk/analysis/judgement/judgement.h>
#include <folk/strategies/registry.h>

#include <cmath>

#include "fuzz.h"

namespace {

std::string written(const folk::RecordedPlay& play) {
  std::string text = "belief,theirs,own,round,match\n";
  for (const auto& match : play.matches) {
    std::string name = "\"";
    for (const char c : match.name) name += c == '"' ? std::string("\"\"") : std::string(1, c);
    name += '"';
    std::size_t number = 0;
    for (const auto& round : match.rounds) {
      if (round.belief) text += folk::to_text(folk::as_written(*round.belief));
      text += ',';
      text += folk::to_char(round.theirs);
      text += round.own == folk::Move::C ? ",0," : ",1,";
      text += std::to_string(++number) + "," + name + "\n";
    }
  }
  return text;
}

bool same(const folk::RecordedPlay& a, const folk::RecordedPlay& b) {
  if (a.matches.size() != b.matches.size()) return false;
  for (std::size_t m = 0; m < a.matches.size(); ++m)
    if (a.matches[m].name != b.matches[m].name || a.matches[m].rounds != b.matches[m].rounds) return false;
  return true;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return folk::fuzz::only_folk_errors(data, size, [](std::string_view text) {
    folk::JudgementQuestion question;
    question.play = folk::read_recorded_play(text, "fuzz.csv");
    folk::fuzz::require(same(question.play, folk::read_recorded_play(written(question.play), "fuzz.csv")));
    if (question.play.rounds() > 200) return;
    static const auto prior =
        folk::read_weighted_roster(folk::Registry::standard(), "tit_for_tat,gtft(0.3),soft_majo,1*memory(1,2)", {});
    question.players = prior;
    question.opponents = prior;
    const auto found = folk::judge_play(question);
    double sum = 0;
    for (const double share : found.own.posterior.candidates) sum += share;
    folk::fuzz::require(std::abs(sum - 1) < 1e-9);
    for (const auto& match : found.matches)
      if (match.class_beliefs) folk::fuzz::require(match.free_beliefs.gain <= match.class_beliefs->gain + 1e-9);
  });
}
