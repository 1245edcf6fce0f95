// The report of sce-check as one HTML page.

#include <folk/tools/sce_check/sections.h>
#include <folk/tools/sce_check/words.h>

#include <fmt/format.h>

namespace folk::tools {
namespace {

/// Nothing but system fonts; every colour of a word comes with a sign, for readers who cannot tell colours apart.
constexpr const char* style = R"(
:root { color-scheme: light; }
body { margin: 0 auto; padding: 1rem; max-width: 64rem; background: #fff; color: #1a1a1a;
  font: 1rem/1.5 system-ui, sans-serif; -webkit-text-size-adjust: 100%; }
h1 { font-size: 1.5rem; line-height: 1.25; overflow-wrap: anywhere; }
h2 { font-size: 1.2rem; margin-top: 2.5rem; border-bottom: 1px solid #ccc; overflow-wrap: anywhere; }
h3 { font-size: 1rem; margin: 1.5rem 0 .4rem; }
p, dd { overflow-wrap: anywhere; }
dl { display: grid; grid-template-columns: max-content minmax(0, 1fr); gap: .15rem 1rem; margin: .6rem 0; }
dt { color: #555; }
dd { margin: 0; }
.scroll, figure { overflow-x: auto; margin: .6rem 0; }
table { border-collapse: collapse; font-size: .875rem; line-height: 1.4; }
th, td { text-align: left; vertical-align: top; padding: .3rem .6rem; border-bottom: 1px solid #ddd; }
th { border-bottom: 2px solid #999; }
th:first-child, td:first-child { padding-left: 0; }
.number { font-variant-numeric: tabular-nums; }
td.number, td.name { white-space: nowrap; }
td.name { max-width: 18rem; white-space: normal; overflow-wrap: anywhere; min-width: 6rem; }
td.long { min-width: 14rem; max-width: 34rem; overflow-wrap: anywhere; }
td.claim { min-width: 9rem; }
td.verdict { min-width: 7.5rem; }
td.claim small { display: block; color: #555; }
.moves, pre { font-family: ui-monospace, monospace; font-size: .875rem; }
pre { overflow-x: auto; padding: .6rem; background: #f5f5f5; }
.word b { white-space: nowrap; }
.yes { color: #116329; }
.open { color: #7a4d00; }
.no { color: #a40e26; }
.none, .missing, .back { color: #666; }
figure img { display: block; height: auto; }
.row { display: flex; flex-wrap: wrap; gap: 1rem; align-items: flex-start; }
.row figure { max-width: 100%; }
.plot img, .wide img { max-width: 100%; }
.automaton img { max-width: max(100%, 44rem); }
.automaton.large img { max-width: none; }
@media screen and (max-width: 40rem) {
  .wide img { max-width: none; width: 40rem; }
  dl { grid-template-columns: minmax(0, 2fr) minmax(0, 3fr); }
  .stacks thead { display: none; }
  .stacks table, .stacks tbody, .stacks tr, .stacks td { display: block; max-width: none; }
  .stacks tr { border-bottom: 1px solid #bbb; padding: .4rem 0; }
  .stacks td { border: 0; padding: .1rem 0; }
  .stacks td:empty { display: none; }
  .stacks td[data-heading]::before { content: attr(data-heading) ": "; color: #555; }
}
@media print {
  body { max-width: none; padding: 0; font-size: 10pt; }
  .scroll, figure { overflow: visible; }
  .row { flex-wrap: nowrap; }
  .row figure { flex: 1 1 0; min-width: 0; }
  figure, tr { break-inside: avoid; }
  h2, h3 { break-after: avoid; }
  figure img, .wide img, .automaton.large img { max-width: 100%; width: auto; }
  td.name, td.long, td.claim { min-width: 0; }
  .back { display: none; }
}
)";

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
  const Html head = Html::markup(
                        "<meta charset=\"utf-8\">\n<meta name=\"viewport\" content=\"width=device-width, "
                        "initial-scale=1\">\n") +
                    element("title", "sce-check: " + page_title(question, report)) + "\n" +
                    element("style", Html::markup(style)) + "\n";
  const Html body = element("body", Html("\n") + body_of(question, report, pictures));
  return "<!DOCTYPE html>\n" +
         element("html", Html("\n") + element("head", Html("\n") + head) + "\n" + body + "\n", {{"lang", "en"}})
             .string() +
         "\n";
}

}  // namespace folk::tools
