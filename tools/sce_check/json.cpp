// What sce-check found, as JSON.

#include <folk/games/outcome.h>
#include <folk/tools/program/json_values.h>
#include <folk/tools/sce_check/output.h>

#include <folk/strategies/machine_text.h>

#include <nlohmann/json.hpp>

namespace folk::tools {
namespace {

/// The moves of both as two strings.
Json moves_of(const std::vector<Outcome>& rounds) {
  std::string own;
  std::string theirs;
  for (const Outcome& round : rounds) {
    own += to_char(round.own);
    theirs += to_char(round.theirs);
  }
  return {{"own", own}, {"theirs", theirs}};
}

Json path_of(const OpponentReport& report) {
  if (!report.path) return nullptr;
  const Json moves = moves_of(report.path->rounds);
  return {{"own", moves["own"]},
          {"theirs", moves["theirs"]},
          {"cycle_from", report.path->cycle ? Json(report.before.size() + *report.path->cycle + 1) : Json(nullptr)},
          {"cut", report.path->cut}};
}

Json states_of(const OpponentReport& report) {
  if (report.states.empty()) return nullptr;
  Json states = Json::array();
  for (const auto& state : report.states)
    states.push_back({{"after", history_text(state.history)}, {"own", state.own}, {"theirs", state.theirs}});
  return states;
}

Json gaps_of(const SideGaps& gaps) {
  Json object = Json::object();
  for (const Notion notion : all_notions) {
    if (notion == Notion::beliefs) continue;
    const auto& gap = gap_of(gaps, notion);
    object[std::string(to_string(notion))] = gap ? Json(gap->gain) : Json(nullptr);
  }
  return object;
}

template <class Ends>
Json thresholds_of(const std::optional<Thresholds>& thresholds, const Ends& ends) {
  if (!thresholds) return nullptr;
  const auto one = [&](const std::optional<Threshold>& threshold) {
    return threshold ? Json(ends(threshold->set)) : Json(nullptr);
  };
  return {{"nash", one(thresholds->nash)},
          {"subgame_perfect", one(thresholds->subgame_perfect)},
          {"self_confirming_unrestricted", one(thresholds->self_confirming_unrestricted)}};
}

std::string then_text(Binding::Then then) {
  switch (then) {
    case Binding::Then::minmax: return "minmax for ever";
    case Binding::Then::plan: return "both go on as their machines say";
    case Binding::Then::best_reply: return "best reply";
  }
  return "?";
}

/// The deviations that bind at the ends, in the order of thresholds_exact; null at the ends 0 and 1.
Json bindings_of(const std::optional<Threshold>& threshold) {
  if (!threshold) return nullptr;
  Json list = Json::array();
  for (const auto& interval : threshold->set.intervals()) {
    Json ends = Json::array();
    for (const auto* end : {&interval.low, &interval.high}) {
      if (end->constraint == DiscountSet::no_constraint) {
        ends.push_back(nullptr);
        continue;
      }
      const Binding& binding = threshold->bindings[end->constraint];
      ends.push_back({{"side", binding.side == Seat::first ? "own" : "theirs"},
                      {"after", history_text(binding.history)},
                      {"deviation", std::string(1, to_char(binding.deviation))},
                      {"then", then_text(binding.then)}});
    }
    list.push_back(ends);
  }
  return list;
}

Json effect_of(const std::optional<sct::BeliefEffect>& effect) {
  if (!effect) return nullptr;
  const auto share = [&](std::uint64_t changed) {
    return effect->rounds == 0 ? 0.0 : static_cast<double>(changed) / static_cast<double>(effect->rounds);
  };
  return {{"rounds", effect->rounds},
          {"changed_by_c", effect->changed_by_c},
          {"changed_by_d", effect->changed_by_d},
          {"present_by_c", effect->present_by_c},
          {"present_by_d", effect->present_by_d},
          {"share_by_c", share(effect->changed_by_c)},
          {"share_by_d", share(effect->changed_by_d)},
          {"decoration", effect->changed_by_c + effect->changed_by_d == 0}};
}

/// The reply that gains, as an @file holds it.
Json reply_of(const Certificate& verdict) {
  constexpr std::size_t most_written = 1000;
  if (!verdict.reply || verdict.reply->size() > most_written) return nullptr;
  return write_machine("best_reply", *verdict.reply);
}

Json verdicts_of(const Certificates& verdicts, const std::array<std::string, all_notions.size()>* worst) {
  Json object = Json::object();
  for (std::size_t n = 0; n < all_notions.size(); ++n) {
    const auto& verdict = verdicts[n];
    const std::string name(to_string(all_notions[n]));
    if (!verdict) {
      object[name] = nullptr;
      continue;
    }
    object[name] = {{"word", verdict->text()},
                    {"side", verdict->side == Seat::first ? "own" : "theirs"},
                    {"margin", verdict->margin},
                    {"margin_exact", verdict->margin_exact.empty() ? Json(nullptr) : Json(verdict->margin_exact)},
                    {"witness", verdict->witness.empty() ? Json(nullptr) : Json(verdict->witness)},
                    {"witness_machine", reply_of(*verdict)}};
    if (worst != nullptr) object[name]["opponent"] = (*worst)[n];
  }
  return object;
}

/// Of each notion the least round from which on it holds, null where there is none, and the verdict on those rounds.
Json settled_of(const SettledNotions& notions) {
  Json object = Json::object();
  for (std::size_t n = 0; n < all_notions.size(); ++n) {
    const auto& settled = notions[n];
    object[std::string(to_string(all_notions[n]))] =
        settled ? Json{{"from", json_optional(settled->from)},
                       {"word", settled->verdict == Verdict::certified     ? "certified"
                                : settled->verdict == Verdict::not_refuted ? "not refuted"
                                                                           : "refuted"}}
                : Json(nullptr);
  }
  return object;
}

Json opponent_of(const OpponentReport& report, const SceQuestion& question) {
  const auto& thresholds = report.thresholds;
  Json object = {{"opponent", report.opponent},
                 {"rounds", question.criterion.is_finite() ? Json(question.criterion.rounds()) : Json(nullptr)},
                 {"score", {{"own", report.own_score}, {"theirs", report.their_score}}},
                 {"figures", std::string(to_string(report.method))},
                 {"path", path_of(report)},
                 {"information_states", states_of(report)},
                 {"information_states_in_all", report.states.empty() ? Json(nullptr) : Json(report.all_states)},
                 {"belief", belief_json(report.belief)},
                 {"gaps", {{"own", gaps_of(report.gaps.first)}, {"theirs", gaps_of(report.gaps.second)}}},
                 {"thresholds", thresholds_of(thresholds, [](const auto& set) { return to_numbers(set); })},
                 {"thresholds_exact", thresholds_of(thresholds, [](const auto& set) { return to_exact_texts(set); })},
                 {"thresholds_bind", nullptr},
                 {"belief_effect", effect_of(report.effect)},
                 {"verdicts", verdicts_of(report.verdicts, nullptr)}};
  if (thresholds)
    object["thresholds_bind"] = {
        {"nash", bindings_of(thresholds->nash)},
        {"subgame_perfect", bindings_of(thresholds->subgame_perfect)},
        {"self_confirming_unrestricted", bindings_of(thresholds->self_confirming_unrestricted)}};
  return object;
}

Json extracted_of(const SceQuestion& question, const std::optional<ExtractedMachine>& extracted) {
  if (!extracted) return nullptr;
  const Extraction& chosen = extracted->tried[extracted->chosen];
  Json differences = Json::array();
  for (const auto& match : chosen.matches.matches)
    if (match.first_difference)
      differences.push_back({{"opponent", match.opponent},
                             {"moves", match.moves},
                             {"equal", match.equal_played ? *match.equal_played : match.equal_told},
                             {"first_difference", *match.first_difference}});
  Json tried = Json::array();
  for (const auto& one : extracted->tried)
    tried.push_back({{"states", one.machine.size()},
                     {"played_alike", json_optional(one.matches.played())},
                     {"told_alike", one.matches.told()}});
  return {{"machine", machine_file(question, *extracted)},
          {"states", chosen.machine.size()},
          {"played_alike", json_optional(chosen.matches.played())},
          {"told_alike", chosen.matches.told()},
          {"unseen", extracted->unseen_name},
          {"unseen_played_alike", json_optional(extracted->unseen.played())},
          {"unseen_told_alike", extracted->unseen.told()},
          {"differences", differences},
          {"tried", tried}};
}

}  // namespace

void write_json(std::ostream& out, const SceQuestion& question, const SceReport& report, bool with_command) {
  Json opponents = Json::array();
  for (const auto& opponent : report.opponents) opponents.push_back(opponent_of(opponent, question));
  Json object = {{"policy", question.policy.name},
                 {"game", to_text(question.payoffs)},
                 {"criterion", question.criterion.to_string()},
                 {"class", question.class_spec},
                 {"side", question.sides == Sides::both    ? "both"
                          : question.sides == Sides::first ? "own"
                                                           : "theirs"},
                 {"epsilon_belief", question.epsilon_belief},
                 {"epsilon_payoff", to_double(question.epsilon_payoff)},
                 {"depth", question.belief_depth()},
                 {"seed", question.seed},
                 {"left_out", question.left_out},
                 {"opponents", opponents},
                 {"overall",
                  {{"belief", belief_json(report.belief)},
                   {"belief_effect", effect_of(report.effect)},
                   {"verdicts", verdicts_of(report.verdicts, &report.worst)}}},
                 {"extracted", extracted_of(question, report.extracted)}};
  if (question.noise > 0) object["noise"] = question.noise.probability();
  if (question.from > 1) {
    object["from"] = question.from;
    for (std::size_t i = 0; i < report.opponents.size(); ++i)
      object["opponents"][i]["before"] = moves_of(report.opponents[i].before);
  }
  if (report.settlement) {
    object["from"] = "settled";
    for (std::size_t i = 0; i < report.opponents.size(); ++i)
      object["opponents"][i]["settled"] = settled_of(report.settlement->pairs[i]);
    object["overall"]["settled"] = settled_of(report.settlement->all);
  }
  if (with_command) {
    object["folk_version"] = FOLK_VERSION;
    object["command"] = question.command;
  }
  out << object.dump(2, ' ', false, Json::error_handler_t::replace) << "\n";
}

}  // namespace folk::tools
