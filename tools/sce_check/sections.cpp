#include <folk/tools/sce_check/sections.h>

#include <folk/tools/sce_check/words.h>

#include <fmt/format.h>

#include <algorithm>

namespace folk::tools {
namespace {

/// Later rounds of a path are in report.json alone.
constexpr std::size_t most_written_rounds = 2000;

/// More situations are in report.json alone.
constexpr std::size_t most_listed_situations = 100;

Html path_section(const OpponentReport& report) {
  Html html;
  if (!report.before.empty())
    html += paragraph(Html("Before, own move first: ") +
                      element_of("span", "moves", path_words({report.before, {}, false}, most_written_rounds)));
  if (report.path)
    html += paragraph(Html("Path, own move first: ") +
                      element_of("span", "moves", path_words(*report.path, most_written_rounds, report.before.size())));
  if (report.states.empty()) return html;
  html += paragraph(fmt::format("{}{} situations have positive probability.",
                                report.states.size() > most_listed_situations ? "The first 100 of " : "",
                                report.states.size()));
  HtmlTable table({"after (own move first)", "own P(C)", "their P(C)"}, {"long", "number", "number"});
  for (std::size_t i = 0; i < std::min(report.states.size(), most_listed_situations); ++i) {
    const InformationState& state = report.states[i];
    table.add({state.history.empty() ? "the start" : history_text(state.history), fmt::format("{:.4g}", state.own),
               fmt::format("{:.4g}", state.theirs)});
  }
  return html + table.html();
}

Html beliefs_section(const OpponentReport& report, const std::string& policy, const Pictures& pictures) {
  if (!report.belief) return {};
  return heading(3, "Beliefs") + pictures.beliefs(report, policy) + belief_list(*report.belief, report.effect);
}

Html gaps_section(const OpponentReport& report, const std::string& policy) {
  HtmlTable table({"what can be gained", "by", "gain", "how"}, {"claim", "name", "number", "long"});
  for (const Notion notion : all_notions) {
    if (notion == Notion::beliefs) continue;
    for (const Seat side : both_seats) {
      const auto& gap = gap_of(side == Seat::first ? report.gaps.first : report.gaps.second, notion);
      if (!gap) continue;
      table.add({std::string(title_of(notion)), side_text(policy, report.opponent, side), gap_text(gap),
                 how_words(notion, *gap)});
    }
  }
  Html html = heading(3, "Gains") + table.html();
  if (report.own_search && report.own_search->gain > 0)
    html +=
        paragraph(fmt::format("On its own beliefs {} expects {} from round {} on as it plays and {} by the deviation; "
                              "{} rounds were searched.",
                              policy, payoff_text(report.own_search->own_value), report.own_search->round,
                              payoff_text(report.own_search->best_value), report.own_search->searched_rounds));
  return html;
}

Html thresholds_section(const OpponentReport& report, const std::string& policy) {
  if (!report.thresholds) return {};
  HtmlTable table({"discounted", "holds for d in", "what binds at the ends (histories with the policy's move first)"},
                  {"claim", "number", "long"});
  const auto add = [&](Notion notion, const std::optional<Threshold>& threshold) {
    Html bindings;
    if (threshold)
      for (const auto& words : binding_words(*threshold, policy, report.opponent)) bindings += element("div", words);
    table.add({std::string(title_of(notion)), threshold ? to_readable_text(threshold->set) : "-", bindings});
  };
  add(Notion::nash, report.thresholds->nash);
  add(Notion::subgame_perfect, report.thresholds->subgame_perfect);
  add(Notion::self_confirming_unrestricted, report.thresholds->self_confirming_unrestricted);
  return heading(3, "Discount factors") + table.html();
}

Html machine_section(const SceQuestion& question, const Strategy& opponent, const Pictures& pictures) {
  if (!opponent.machine) return {};
  if (question.policy.machine && opponent.name == question.policy.name) return {};  // drawn already
  return heading(3, Html("The automaton of ") + opponent.name) + pictures.machine(opponent.name, *opponent.machine);
}

Html fidelity_table(const Fidelity& fidelity) {
  HtmlTable table({"opponent", "moves", "played alike", "told alike", "first otherwise in round"},
                  {"name", "number", "number", "number", "number"});
  for (const auto& match : fidelity.matches)
    table.add({match.opponent, std::to_string(match.moves),
               match.equal_played ? std::to_string(*match.equal_played) : "-", std::to_string(match.equal_told),
               match.first_difference ? std::to_string(*match.first_difference) : "-"});
  return table.html();
}

Html trade_off_table(const ExtractedMachine& extracted) {
  HtmlTable table(
      {"states", "a state had to save", "moves built from", "of these otherwise", "played alike", "told alike", ""},
      {"number", "number", "number", "number", "number", "number", ""});
  for (std::size_t i = 0; i < extracted.tried.size(); ++i) {
    const Extraction& one = extracted.tried[i];
    table.add({std::to_string(one.machine.size()), fmt::format("over {:g} moves", one.state_price),
               std::to_string(one.built_from), std::to_string(one.wrong), share_text(one.matches.played()),
               share_text(one.matches.told()), i == extracted.chosen ? "chosen" : ""});
  }
  return table.html();
}

}  // namespace

Html belief_list(const BeliefConsistency& belief, const std::optional<sct::BeliefEffect>& effect) {
  Html list;
  const auto add = [&](const Html& name, const Html& value) { list += element("dt", name) + element("dd", value); };
  add("right", fmt::format("{} of {} rounds ({})", belief.right, belief.rounds, share_text(belief.accuracy())));
  add("distance to the truth", fmt::format("at most {}, on average {}", measure_text(belief.largest_distance),
                                           measure_text(belief.mean_distance())));
  add("log loss, Brier score", measure_text(belief.log_loss()) + ", " + measure_text(belief.brier()));
  add("always right", belief.settled_from() ? fmt::format("from round {} on", *belief.settled_from())
                                            : std::string("not even at the end"));
  add("wrong in rounds", rounds_words(belief.wrong_rounds));
  if (effect)
    add("forced to C, to D",
        fmt::format("{} and {} of {} moves change{}", effect->changed_by_c, effect->changed_by_d, effect->rounds,
                    effect->changed_by_c + effect->changed_by_d == 0 ? ": it is decoration" : ""));
  return element("dl", list) + "\n";
}

Html opponent_section(const SceQuestion& question, const SceReport& report, std::size_t opponent,
                      const Pictures& pictures) {
  const OpponentReport& one = report.opponents[opponent];
  const std::string& policy = question.policy.name;
  Html html = heading(2, Html("Against ") + one.opponent);
  html += paragraph(fmt::format("Score {} : {} ({}).", payoff_text(one.own_score), payoff_text(one.their_score),
                                to_string(one.method)));
  html += path_section(one);
  if (report.opponents.size() > 1)
    html += heading(3, "Verdicts") + verdict_table(one.verdicts, nullptr, one.belief.has_value());
  html += beliefs_section(one, policy, pictures);
  html += gaps_section(one, policy);
  html += thresholds_section(one, policy);
  html += machine_section(question, question.opponents[opponent], pictures);
  if (report.opponents.size() > 1) html += element_of("p", "back", link("opponents", "all opponents")) + "\n";
  return element("section", html, {{"id", opponent_id(opponent)}}) + "\n";
}

Html extracted_section(const SceQuestion& question, const ExtractedMachine& extracted, const Pictures& pictures) {
  const Extraction& chosen = extracted.tried[extracted.chosen];
  const std::string& policy = question.policy.name;
  Html html = heading(2, Html("An automaton that plays as ") + policy + " does");
  html += paragraph(fmt::format(
      "{} states. Of the moves of {} it makes {} when it plays the opponents itself, {} when it is told the matches; "
      "against {}, which it was not built from, {} and {}.",
      chosen.machine.size(), policy, share_text(chosen.matches.played()), share_text(chosen.matches.told()),
      extracted.unseen_name, share_text(extracted.unseen.played()), share_text(extracted.unseen.told())));
  html += pictures.automaton(extracted_name(question), chosen.machine, Sense::own_moves_its_own);
  html += heading(3, "How faithful it is") + fidelity_table(chosen.matches);
  html += heading(3, "What fewer states cost") + trade_off_table(extracted);
  html += heading(3, "As a file (@FILE)") + element("pre", machine_file(question, extracted));
  return element("section", html, {{"id", "extracted"}}) + "\n";
}

}  // namespace folk::tools
