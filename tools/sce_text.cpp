// What sce-check found, as text for people and as CSV.

#include "csv.h"
#include "sce_output.h"
#include "table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace folk::tools {
namespace {

/// Paths are shown up to this many rounds.
constexpr std::size_t most_shown = 200;

std::string number(double value) {
  return value == std::floor(value) && std::abs(value) < 1e15 ? fmt::format("{:.0f}", value)
                                                              : fmt::format("{:.4f}", value);
}

std::string percent(const std::optional<double>& share) { return share ? fmt::format("{:.2f} %", 100 * *share) : "-"; }

std::string_view side_name(Seat side) { return side == Seat::row ? "own" : "theirs"; }

std::string effect_text(const std::optional<sct::BeliefEffect>& effect) {
  return effect ? fmt::format("{} / {} of {}", effect->changed_by_c, effect->changed_by_d, effect->rounds) : "-";
}

std::string word_of(const std::optional<Certificate>& verdict) {
  return verdict ? verdict->text() : std::string("does not apply");
}

void write_header(std::ostream& out, const SceQuestion& question, const SceReport& report) {
  out << fmt::format("{} against {}\n", question.policy.name,
                     report.opponents.size() == 1
                         ? report.opponents.front().opponent
                         : fmt::format("the {} of {}", report.opponents.size(), question.opponents_spec));
  out << fmt::format("game {} ({}), {}, class {}, epsilon-belief {}, epsilon-payoff {}, depth {}, seed {}\n",
                     question.game.title, to_text(question.game.payoffs), question.criterion.to_string(),
                     question.class_spec, question.epsilon_belief, question.epsilon_payoff, question.depth,
                     question.seed);
}

std::string line_of(Notion notion, const Certificate& verdict) {
  std::string text = fmt::format("  {:<34} {}", title_of(notion), verdict.text());
  if (verdict.margin > 0)
    text += fmt::format("  {} {}", notion == Notion::beliefs ? "distance" : "gain",
                        verdict.margin_exact.empty() || verdict.margin_exact.size() > 20 ? number(verdict.margin)
                                                                                         : verdict.margin_exact);
  if (notion != Notion::beliefs && verdict.margin > 0) text += fmt::format(" ({})", side_name(verdict.side));
  if (!verdict.witness.empty()) text += ": " + verdict.witness;
  return text + "\n";
}

std::string path_text(const PlayPath& path) {
  const bool all = path.rounds.size() <= most_shown;
  const auto shown =
      all ? path.rounds
          : std::vector<Round>(path.rounds.begin(), path.rounds.begin() + static_cast<std::ptrdiff_t>(most_shown));
  std::string text = history_text(shown);
  if (!all) text += " ...";
  if (path.cycle) text += fmt::format(", again and again from round {}", *path.cycle + 1);
  if (path.cut) text += ", ...";
  return text;
}

std::string rounds_text(const std::vector<std::uint64_t>& rounds) {
  if (rounds.empty()) return "none";
  std::vector<std::uint64_t> shown(rounds.begin(), rounds.begin() + std::min<std::ptrdiff_t>(20, std::ssize(rounds)));
  return fmt::format("{}{}", fmt::join(shown, ", "), rounds.size() > shown.size() ? ", ..." : "");
}

void write_belief(std::ostream& out, const BeliefConsistency& belief) {
  out << fmt::format("beliefs   {} right, distance to the truth at most {:.4g}, on average {:.4g}\n",
                     percent(belief.accuracy()), belief.largest_distance, belief.mean_distance().value_or(0));
  out << fmt::format(
      "          log loss {:.4g}, Brier score {:.4g}, {}\n", belief.log_loss().value_or(0), belief.brier().value_or(0),
      belief.settled_from() ? fmt::format("right from round {} on", *belief.settled_from()) : "wrong at the end");
  out << fmt::format("          wrong in rounds: {}\n", rounds_text(belief.wrong_rounds));
}

void write_one(std::ostream& out, const OpponentReport& report, const SceQuestion& question) {
  out << fmt::format("\nscore     {} to {} ({})\n", number(report.own_score), number(report.their_score),
                     to_string(report.method));
  if (report.path) out << "path      " << path_text(*report.path) << " (own move first)\n";
  if (!report.states.empty()) {
    out << fmt::format("states    {} situations of positive probability; after ...: P(C) own, theirs\n",
                       report.states.size());
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
  if (report.thresholds) {
    const auto set = [](const std::optional<Threshold>& threshold) {
      return threshold ? to_text(threshold->set) : std::string("-");
    };
    out << fmt::format("\ndiscount factors at which it holds: Nash {}; subgame perfect {}; self-confirming {}\n",
                       set(report.thresholds->nash), set(report.thresholds->subgame_perfect),
                       set(report.thresholds->self_confirming_unrestricted));
  }
  static_cast<void>(question);
}

void write_tables(std::ostream& out, const SceReport& report) {
  const bool believes = report.belief.has_value();
  if (believes) {
    Table beliefs({"opponent", "score", "right", "sup TV", "mean TV", "settled", "effect C / D"});
    for (const auto& one : report.opponents) {
      if (!one.belief) continue;
      const auto settled = one.belief->settled_from();
      beliefs.add({one.opponent, number(one.own_score), percent(one.belief->accuracy()),
                   fmt::format("{:.4f}", one.belief->largest_distance),
                   fmt::format("{:.4f}", one.belief->mean_distance().value_or(0)),
                   settled ? std::to_string(*settled) : "-", effect_text(one.effect)});
    }
    out << "\n" << beliefs.text();
  }
  Table gaps({"opponent", "Nash", "Nash of theirs", "perfect", "SCE free", "SCE class", "SCE own", "believed to be"});
  for (const auto& one : report.opponents) {
    const auto& own = one.gaps.first;
    gaps.add({one.opponent, gap_text(own.nash), gap_text(one.gaps.second.nash), gap_text(own.subgame_perfect),
              gap_text(own.self_confirming_unrestricted), gap_text(own.self_confirming_class),
              gap_text(own.self_confirming_own),
              own.self_confirming_class ? own.self_confirming_class->witness.belief : "-"});
  }
  out << "\nwhat the policy can gain (Nash of theirs: what the opponent can), 0 in equilibrium; >= is a lower bound\n"
      << gaps.text();
}

void write_extracted(std::ostream& out, const ExtractedMachine& extracted) {
  out << "\nautomata that play as it does\n";
  Table tried({"states", "played alike", "told alike", ""});
  for (std::size_t i = 0; i < extracted.tried.size(); ++i) {
    const auto& one = extracted.tried[i];
    tried.add({std::to_string(one.machine.size()), percent(one.matches.played()), percent(one.matches.told()),
               i == extracted.chosen ? "chosen" : ""});
  }
  out << tried.text();
  out << fmt::format("on {}, which it was not built from: {} played alike, {} told\n", extracted.unseen_name,
                     percent(extracted.unseen.played()), percent(extracted.unseen.told()));
  for (const auto& match : extracted.tried[extracted.chosen].matches.matches)
    if (match.first_difference)
      out << fmt::format("  against {}: {} of {} moves alike, first otherwise in round {}\n", match.opponent,
                         match.equal_played.value_or(match.equal_told), match.moves, *match.first_difference);
}

}  // namespace

std::string_view title_of(Notion notion) {
  switch (notion) {
    case Notion::nash: return "Nash";
    case Notion::subgame_perfect: return "subgame perfect";
    case Notion::self_confirming_unrestricted: return "self-confirming, free beliefs";
    case Notion::self_confirming_class: return "self-confirming, class of beliefs";
    case Notion::self_confirming_own: return "self-confirming, own beliefs";
    case Notion::beliefs: return "beliefs true on the path";
  }
  return "?";
}

std::string gap_text(const std::optional<Gap>& gap) {
  if (!gap) return "-";
  const std::string exact = gap->exact ? to_text(*gap->exact) : std::string();
  return (gap->bounded() ? ">= " : "") + (exact.empty() || exact.size() > 12 ? number(gap->gain) : exact);
}

void write_text(std::ostream& out, const SceQuestion& question, const SceReport& report) {
  write_header(out, question, report);
  if (report.opponents.size() == 1)
    write_one(out, report.opponents.front(), question);
  else
    write_tables(out, report);
  if (report.belief && report.opponents.size() > 1)
    out << fmt::format("\nbeliefs in all: {} right, log loss {:.4g}, Brier score {:.4g}; effect C / D {}\n",
                       percent(report.belief->accuracy()), report.belief->log_loss().value_or(0),
                       report.belief->brier().value_or(0), effect_text(report.effect));
  if (report.extracted) write_extracted(out, *report.extracted);
  out << (report.opponents.size() == 1 ? "\nverdicts\n" : "\nverdicts (the worst of all opponents)\n");
  for (std::size_t n = 0; n < all_notions.size(); ++n) {
    if (!report.verdicts[n]) {
      out << fmt::format("  {:<34} {}\n", title_of(all_notions[n]), word_of(report.verdicts[n]));
      continue;
    }
    std::string line = line_of(all_notions[n], *report.verdicts[n]);
    if (report.opponents.size() > 1) line.insert(line.size() - 1, fmt::format(" [{}]", report.worst[n]));
    out << line;
  }
}

void write_csv(std::ostream& out, const SceQuestion&, const SceReport& report) {
  out << "opponent,own_score,their_score,accuracy,sup_tv,mean_tv,log_loss,brier,settled_from";
  for (const char* side : {"own", "theirs"})
    for (const Notion notion : all_notions)
      if (notion != Notion::beliefs) out << "," << side << "_" << to_string(notion);
  for (const Notion notion : all_notions) out << ",verdict_" << to_string(notion);
  out << "\n";
  const auto optional = [](const auto& value) { return value ? fmt::format("{}", *value) : std::string(); };
  for (const auto& one : report.opponents) {
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
    out << "\n";
  }
}

}  // namespace folk::tools
