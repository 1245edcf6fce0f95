// The report of sce-check as one HTML page.

#include <folk/tools/program/html_document.h>
#include <folk/tools/sce_check/sections.h>
#include <folk/tools/sce_check/words.h>

#include <fmt/format.h>

namespace folk::tools {
namespace {

std::string page_title(const SceQuestion& question, const SceReport& report) {
  return question.policy.name + " against " +
         (report.opponents.size() == 1 ? report.opponents.front().opponent
                                       : fmt::format("the {} of {}", report.opponents.size(), question.opponents_spec));
}

std::string side_words(Sides sides) {
  switch (sides) {
    case Sides::both: return "both sides";
    case Sides::first: return "the policy alone";
    case Sides::second: return "the opponent alone";
  }
  return "?";
}

/// What was asked, every default included.
Html question_list(const SceQuestion& question) {
  Html list;
  const auto add = [&](const Html& name, const Html& value) { list += element("dt", name) + element("dd", value); };
  add("policy", question.policy.name);
  add("opponents", question.opponents_spec);
  add("game", question.game.title + ", " + to_text(question.payoffs));
  if (const std::string actions = action_words(question.game); !actions.empty()) add("actions", actions);
  add("criterion", question.criterion.to_string());
  if (question.from > 1) add("asked from", fmt::format("round {} on, after what was played before it", question.from));
  if (question.noise > 0)
    add("noise", fmt::format("each move flips with probability {}", to_short_text(question.noise)));
  add("class of beliefs", fmt::format("{} ({} machine{})", question.class_spec, question.beliefs.size(),
                                      question.beliefs.size() == 1 ? "" : "s"));
  add("whose gains count", side_words(question.sides));
  add("epsilon",
      fmt::format("belief {}, payoff {}", to_short_text(question.epsilon_belief), to_text(question.epsilon_payoff)));
  add("depth of its own search", std::to_string(question.belief_depth()));
  add("seed, repetitions", fmt::format("{}, {}", question.seed, question.repetitions));
  if (!question.left_out.empty()) add("left out, without end", fmt::format("{}", fmt::join(question.left_out, ", ")));
  if (!question.policy.caveat.empty()) add("note", question.policy.caveat);
  add("made by", fmt::format("Folk {}: {}", FOLK_VERSION, question.command));
  return element("dl", list) + "\n";
}

/// Of all opponents together.
Html overall_beliefs(const SceReport& report, const Pictures& pictures) {
  if (!report.belief) return {};
  Html html = heading(2, "Beliefs");
  if (report.opponents.size() > 1) html += belief_list(*report.belief, report.effect);
  return html + element_of("div", "row", pictures.accuracy(report) + pictures.calibration(report)) + "\n";
}

Html body_of(const SceQuestion& question, const SceReport& report, const Pictures& pictures) {
  const bool several = report.opponents.size() > 1;
  Html html = heading(1, page_title(question, report));
  html += heading(2, several ? "Verdicts: the worst of all opponents" : "Verdicts");
  html += verdict_table(report.verdicts, several ? &report.worst : nullptr, report.belief.has_value());
  html += question_list(question);
  if (report.settlement) html += settlement_section(report);
  html += overall_beliefs(report, pictures);
  if (several) {
    html += element("h2", "Opponents", {{"id", "opponents"}}) + "\n";
    html +=
        element("p", "Gains are own / theirs, 0 in equilibrium; >= is a lower bound; d is the discount factor.") + "\n";
    html += opponent_table(report);
  }
  if (question.policy.machine)
    html += element("h2", Html("The automaton of ") + question.policy.name) + "\n" +
            pictures.machine(question.policy.name, *question.policy.machine);
  for (std::size_t i = 0; i < report.opponents.size(); ++i) html += opponent_section(question, report, i, pictures);
  if (report.extracted) html += extracted_section(question, *report.extracted, pictures);
  return html;
}

}  // namespace

std::string html_page(const SceQuestion& question, const SceReport& report) {
  const Pictures pictures({game_words(question.game.title, question.payoffs), question.criterion.to_string()});
  return html_document("sce-check: " + page_title(question, report), report_style, body_of(question, report, pictures));
}

}  // namespace folk::tools
