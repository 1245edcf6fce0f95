// What sce-check found, as text for people and as CSV.

#include <folk/tools/choices/game_option.h>
#include <folk/tools/program/csv.h>
#include <folk/tools/program/table.h>
#include <folk/tools/sce_check/output.h>
#include <folk/tools/sce_check/words.h>

#include <fmt/format.h>
#include <folk/games/utf8.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace folk::tools {
namespace {

/// Paths are shown up to this many rounds.
constexpr std::size_t most_shown = 200;

std::string effect_text(const std::optional<sct::BeliefEffect>& effect) {
  return effect ? fmt::format("{} / {} of {}", effect->changed_by_c, effect->changed_by_d, effect->rounds) : "-";
}

void write_header(std::ostream& out, const SceQuestion& question, const SceReport& report) {
  out << visible_line(fmt::format("{} against {}", question.policy.name,
                                  report.opponents.size() == 1
                                      ? report.opponents.front().opponent
                                      : fmt::format("the {} of {}", report.opponents.size(), question.opponents_spec)));
  const std::string noise = question.noise > 0 ? fmt::format(", noise {}", to_short_text(question.noise)) : "";
  out << fmt::format("game {} ({}), {}{}{}, class {}, epsilon-belief {}, epsilon-payoff {}, depth {}, seed {}\n",
                     shown_title(question.game.title), to_text(question.payoffs), question.criterion.to_string(),
                     from_words(question), noise, visible_text(question.class_spec),
                     to_short_text(question.epsilon_belief), to_text(question.epsilon_payoff), question.belief_depth(),
                     question.seed);
  if (const std::string actions = action_words(question.game); !actions.empty()) out << actions << "\n";
  if (!question.left_out.empty())
    out << visible_line(
        fmt::format("left out of the default opponents, machines without end: {}", fmt::join(question.left_out, ", ")));
}

std::string line_of(Notion notion, const Certificate& verdict) {
  std::string text = fmt::format("  {:<34} {}", title_of(notion), verdict.text());
  if (verdict.margin > 0 || verdict.verdict == Verdict::refuted)
    text += fmt::format("  {} {}", notion == Notion::beliefs ? "distance" : "gain", margin_text(notion, verdict));
  if (!verdict.witness.empty()) text += ": " + verdict.witness;
  return visible_line(text);
}

std::string set_text(const std::optional<Threshold>& threshold) {
  return threshold ? to_readable_text(threshold->set) : "-";
}

void write_belief(std::ostream& out, const BeliefConsistency& belief) {
  out << fmt::format("beliefs   {} right, distance to the truth at most {:.4g}, on average {:.4g}\n",
                     share_text(belief.accuracy()), belief.largest_distance, belief.mean_distance().value_or(0));
  out << fmt::format(
      "          log loss {:.4g}, Brier score {:.4g}, {}\n", belief.log_loss().value_or(0), belief.brier().value_or(0),
      belief.settled_from() ? fmt::format("right from round {} on", *belief.settled_from()) : "wrong at the end");
  out << fmt::format("          wrong in rounds: {}\n", rounds_words(belief.wrong_rounds));
}

void write_one(std::ostream& out, const OpponentReport& report) {
  out << fmt::format("\nscore     {} to {} ({})\n", payoff_text(report.own_score), payoff_text(report.their_score),
                     to_string(report.method));
  if (!report.before.empty())
    out << fmt::format("before    {} (own move first)\n", path_words({report.before, {}, false}, most_shown));
  if (report.path)
    out << fmt::format("path      {} (own move first)\n", path_words(*report.path, most_shown, report.before.size()));
  if (!report.states.empty()) {
    out << fmt::format("states    {} situations of positive probability; after ...: P(C) own, theirs\n",
                       report.all_states);
    for (std::size_t i = 0; i < std::min<std::size_t>(report.states.size(), 12); ++i)
      out << fmt::format("          {}: {:.4g}, {:.4g}\n",
                         report.states[i].history.empty() ? "(start)" : history_text(report.states[i].history),
                         report.states[i].own, report.states[i].theirs);
  }
  if (report.belief) write_belief(out, *report.belief);
  if (report.effect)
    out << fmt::format("effect    forcing the belief to C changes {} of {} moves, to D {}{}\n",
                       report.effect->changed_by_c, report.effect->rounds, report.effect->changed_by_d,
                       report.effect->changed_by_c + report.effect->changed_by_d == 0 ? ": it is decoration" : "");
  Table gaps({"what can be gained", "own", "theirs"});
  for (const Notion notion : all_notions)
    if (notion != Notion::beliefs)
      gaps.add({std::string(title_of(notion)), gap_text(gap_of(report.gaps.first, notion)),
                gap_text(gap_of(report.gaps.second, notion))});
  out << "\n" << gaps.text();
  if (report.thresholds)
    out << fmt::format("\ndiscount factors at which it holds: Nash {}; subgame perfect {}; self-confirming {}\n",
                       set_text(report.thresholds->nash), set_text(report.thresholds->subgame_perfect),
                       set_text(report.thresholds->self_confirming_unrestricted));
}

void write_tables(std::ostream& out, const SceReport& report) {
  const bool believes = report.belief.has_value();
  if (believes) {
    Table beliefs({"opponent", "score", "right", "sup TV", "mean TV", "settled", "effect C / D"});
    ColumnForm scores;
    for (const auto& one : report.opponents)
      if (one.belief) scores.add(one.own_score);
    for (const auto& one : report.opponents) {
      if (!one.belief) continue;
      const auto settled = one.belief->settled_from();
      beliefs.add({one.opponent, scores.text(one.own_score), share_text(one.belief->accuracy()),
                   fmt::format("{:.4f}", one.belief->largest_distance),
                   fmt::format("{:.4f}", one.belief->mean_distance().value_or(0)),
                   settled ? std::to_string(*settled) : "-", effect_text(one.effect)});
    }
    out << "\n" << beliefs.text();
  }
  Table gaps({"opponent", "Nash", "Nash of theirs", "perfect", "SCE free", "SCE class", "SCE own", "believed to be"});
  const auto columns = [](const OpponentReport& one) {
    const auto& own = one.gaps.first;
    return std::array{&own.nash,
                      &one.gaps.second.nash,
                      &own.subgame_perfect,
                      &own.self_confirming_unrestricted,
                      &own.self_confirming_class,
                      &own.self_confirming_own};
  };
  std::array<ColumnForm, 6> forms;
  for (const auto& one : report.opponents)
    for (std::size_t c = 0; c < forms.size(); ++c) forms[c].add(*columns(one)[c]);
  for (const auto& one : report.opponents) {
    std::vector<std::string> row{one.opponent};
    for (std::size_t c = 0; c < forms.size(); ++c) row.push_back(forms[c].text(*columns(one)[c]));
    const auto& known = one.gaps.first.self_confirming_class;
    row.push_back(known ? known->witness.belief : "-");
    gaps.add(std::move(row));
  }
  out << "\nwhat the policy can gain (Nash of theirs: what the opponent can), 0 in equilibrium; >= is a lower bound\n"
      << gaps.text();
}

/// Where there are two deterministic machines.
void write_thresholds(std::ostream& out, const SceReport& report) {
  Table sets({"opponent", "Nash", "subgame perfect", "self-confirming"});
  std::vector<std::string> without;
  bool any = false;
  for (const auto& one : report.opponents) {
    if (!one.thresholds) {
      without.push_back(one.opponent);
      continue;
    }
    any = true;
    sets.add({one.opponent, set_text(one.thresholds->nash), set_text(one.thresholds->subgame_perfect),
              set_text(one.thresholds->self_confirming_unrestricted)});
  }
  if (!any) return;
  out << "\ndiscount factors at which it holds\n" << sets.text();
  if (!without.empty())
    out << fmt::format("(of two deterministic machines with an end: not against {})\n", fmt::join(without, ", "));
}

void write_extracted(std::ostream& out, const ExtractedMachine& extracted) {
  out << "\nautomata that play as it does\n";
  Table tried({"states", "played alike", "told alike", ""});
  for (std::size_t i = 0; i < extracted.tried.size(); ++i) {
    const auto& one = extracted.tried[i];
    tried.add({std::to_string(one.machine.size()), share_text(one.matches.played()), share_text(one.matches.told()),
               i == extracted.chosen ? "chosen" : ""});
  }
  out << tried.text();
  out << visible_line(fmt::format("on {}, which it was not built from: {} played alike, {} told", extracted.unseen_name,
                                  share_text(extracted.unseen.played()), share_text(extracted.unseen.told())));
  for (const auto& match : extracted.tried[extracted.chosen].matches.matches)
    if (match.first_difference)
      out << visible_line(fmt::format("  against {}: {} of {} moves alike, first otherwise in round {}", match.opponent,
                                      match.equal_played.value_or(match.equal_told), match.moves,
                                      *match.first_difference));
}

/// A notion a line for one opponent, else a row an opponent.
void write_settlement(std::ostream& out, const SceReport& report) {
  const Settlement& settlement = *report.settlement;
  out << "\nfrom which round on it holds for good (?: is not refuted)\n";
  if (report.opponents.size() == 1) {
    for (std::size_t n = 0; n < all_notions.size(); ++n)
      out << fmt::format("  {:<34} {}\n", title_of(all_notions[n]), settled_text(settlement.all[n]));
    return;
  }
  Table table({"opponent", "Nash", "perfect", "SCE free", "SCE class", "SCE own", "beliefs"});
  const auto add = [&](const std::string& name, const SettledNotions& notions) {
    std::vector<std::string> row{name};
    for (const auto& notion : notions) row.push_back(settled_text(notion));
    table.add(std::move(row));
  };
  for (std::size_t i = 0; i < report.opponents.size(); ++i) add(report.opponents[i].opponent, settlement.pairs[i]);
  add("all of them", settlement.all);
  out << table.text();
}

}  // namespace

void write_text(std::ostream& out, const SceQuestion& question, const SceReport& report) {
  write_header(out, question, report);
  if (report.opponents.size() == 1)
    write_one(out, report.opponents.front());
  else
    write_tables(out, report);
  if (report.opponents.size() > 1) write_thresholds(out, report);
  if (report.belief && report.opponents.size() > 1)
    out << fmt::format("\nbeliefs in all: {} right, log loss {:.4g}, Brier score {:.4g}; effect C / D {}\n",
                       share_text(report.belief->accuracy()), report.belief->log_loss().value_or(0),
                       report.belief->brier().value_or(0), effect_text(report.effect));
  if (report.extracted) write_extracted(out, *report.extracted);
  out << (report.opponents.size() == 1 ? "\nverdicts\n" : "\nverdicts (the worst of all opponents)\n");
  for (std::size_t n = 0; n < all_notions.size(); ++n) {
    if (!report.verdicts[n]) {
      out << fmt::format("  {:<34} {}\n", title_of(all_notions[n]),
                         absence_words(all_notions[n], report.belief.has_value()));
      continue;
    }
    std::string line = line_of(all_notions[n], *report.verdicts[n]);
    if (report.opponents.size() > 1) line.insert(line.size() - 1, fmt::format(" [{}]", visible_text(report.worst[n])));
    out << line;
  }
  if (report.settlement) write_settlement(out, report);
}

void write_csv(std::ostream& out, const SceQuestion& question, const SceReport& report) {
  out << "opponent,own_score,their_score,accuracy,sup_tv,mean_tv,log_loss,brier,settled_from";
  for (const char* side : {"own", "theirs"})
    for (const Notion notion : all_notions)
      if (notion != Notion::beliefs) out << "," << side << "_" << to_string(notion);
  for (const Notion notion : all_notions) out << ",verdict_" << to_string(notion);
  if (question.from > 1) out << ",from";
  if (report.settlement)
    for (const Notion notion : all_notions) out << ",settled_" << to_string(notion);
  out << "\n";
  const auto optional = [](const auto& value) { return value ? fmt::format("{}", *value) : std::string(); };
  for (std::size_t i = 0; i < report.opponents.size(); ++i) {
    const auto& one = report.opponents[i];
    out << csv_field(one.opponent) << fmt::format(",{},{}", one.own_score, one.their_score);
    if (one.belief)
      out << fmt::format(",{},{},{},{},{},{}", optional(one.belief->accuracy()), one.belief->largest_distance,
                         optional(one.belief->mean_distance()), optional(one.belief->log_loss()),
                         optional(one.belief->brier()), optional(one.belief->settled_from()));
    else
      out << ",,,,,,";
    for (const auto* gaps : {&one.gaps.first, &one.gaps.second})
      for (const Notion notion : all_notions)
        if (notion != Notion::beliefs) {
          const auto& gap = gap_of(*gaps, notion);
          out << "," << (gap ? fmt::format("{}", gap->gain) : std::string());
        }
    for (const auto& verdict : one.verdicts) out << "," << (verdict ? csv_field(verdict->text()) : std::string());
    if (question.from > 1) out << "," << question.from;
    if (report.settlement)
      for (const auto& notion : report.settlement->pairs[i]) out << "," << (notion ? settled_text(notion) : "");
    out << "\n";
  }
}

}  // namespace folk::tools
