#include <folk/tools/sce_check/words.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace folk::tools {
namespace {

std::string then_words(Binding::Then then) {
  switch (then) {
    case Binding::Then::minmax: return "and is held to its minmax for ever";
    case Binding::Then::plan: return "and both go on as their machines say";
    case Binding::Then::best_reply: return "and goes on with a best reply";
  }
  return "?";
}

/// Class of style and sign of a judgement.
struct Look {
  const char* css_class;
  const char* sign;
};

Look look_of(const std::optional<Certificate>& verdict) {
  if (!verdict) return {"none", "–"};
  switch (verdict->verdict) {
    case Verdict::certified: return {"yes", "✓"};
    case Verdict::not_refuted: return {"open", "?"};
    case Verdict::refuted: break;
  }
  return {"no", "✗"};
}

}  // namespace

std::string side_text(const std::string& policy, const std::string& opponent, Seat side) {
  if (policy == opponent) return side == Seat::first ? "the first" : "the second";
  return side == Seat::first ? policy : opponent;
}

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
  return (gap->bounded() ? ">= " : "") + (exact.empty() || exact.size() > 12 ? payoff_text(gap->gain) : exact);
}

void ColumnForm::add(double value) { whole_ = whole_ && value == std::floor(value) && std::abs(value) < 1e15; }

std::string ColumnForm::text(double value) const { return fmt::format("{:.{}f}", value, whole_ ? 0 : 4); }

std::string ColumnForm::text(const std::optional<Gap>& gap) const {
  if (!gap) return "-";
  // What is too small to show is not nothing.
  const bool vanishes = gap->gain != 0 && std::abs(gap->gain) < 5e-5;
  return (gap->bounded() ? ">= " : "") + (vanishes ? fmt::format("{:.0e}", gap->gain) : text(gap->gain));
}

std::string meaning_of(Notion notion) {
  switch (notion) {
    case Notion::nash: return "Nobody gains by playing another strategy from the start.";
    case Notion::subgame_perfect: return "Nor after any history that deviations of either side can lead to.";
    case Notion::self_confirming_unrestricted:
      return "Nobody gains by leaving the path who may believe anything of what happens off it.";
    case Notion::self_confirming_class:
      return "Nobody gains who believes the other to be some machine of the class that plays the same path.";
    case Notion::self_confirming_own: return "The policy does best by what it itself believes.";
    case Notion::beliefs: return "What the policy expects is what the opponent does.";
  }
  return "?";
}

std::string_view absence_words(Notion notion, bool believes) {
  const bool of_beliefs = notion == Notion::self_confirming_own || notion == Notion::beliefs;
  return of_beliefs && !believes ? "does not apply" : "unknown";
}

Html word_of(const std::optional<Certificate>& verdict, std::string_view absent) {
  const Look look = look_of(verdict);
  const std::string text = verdict ? verdict->text() : std::string(absent);
  // How far was looked, "(depth 6)", is set apart from the word.
  const std::size_t scope = std::min(text.find(" ("), text.size());
  const Html word = element("b", Html(look.sign) + " " + text.substr(0, scope));
  return element_of("span", std::string("word ") + look.css_class, word + text.substr(scope));
}

Html sign_of(const std::optional<Certificate>& verdict, std::string_view absent) {
  const Look look = look_of(verdict);
  return element(
      "span", look.sign,
      {{"class", std::string("word ") + look.css_class}, {"title", verdict ? verdict->text() : std::string(absent)}});
}

std::string margin_text(Notion notion, const Certificate& verdict) {
  // Too small for a double is not 0.
  if (verdict.margin == 0 && !verdict.margin_exact.empty() && verdict.margin_exact != "0") return "above 0";
  const bool exact = !verdict.margin_exact.empty() && verdict.margin_exact.size() <= 20;
  const std::string margin = exact ? verdict.margin_exact : payoff_text(verdict.margin);
  if (notion == Notion::beliefs) return margin;
  return verdict.margin > 0 ? fmt::format("{} ({})", margin, verdict.side == Seat::first ? "own" : "theirs") : margin;
}

std::string settled_text(const std::optional<Settled>& settled) {
  if (!settled) return "-";
  if (!settled->from) return "never";
  return std::to_string(*settled->from) + (settled->verdict == Verdict::certified ? "" : "?");
}

std::string from_words(const SceQuestion& question) {
  return question.from > 1 ? fmt::format(", from round {} on", question.from) : "";
}

std::string path_words(const PlayPath& path, std::size_t most, std::size_t before) {
  const auto shown = static_cast<std::ptrdiff_t>(std::min(path.rounds.size(), most));
  std::string text = history_text({path.rounds.begin(), path.rounds.begin() + shown});
  if (path.rounds.size() > most)
    return text + fmt::format(" ... (the first {} of {} rounds)", shown, path.rounds.size());
  if (path.cycle) text += fmt::format(", again and again from round {}", before + *path.cycle + 1);
  return path.cut ? text + " ..." : text;
}

std::string rounds_words(const std::vector<std::uint64_t>& rounds) {
  std::string text;
  for (std::size_t i = 0; i < rounds.size();) {
    std::size_t end = i + 1;
    while (end < rounds.size() && rounds[end] == rounds[end - 1] + 1) ++end;
    text += text.empty() ? "" : ", ";
    text += end - i > 2 ? fmt::format("{}-{}", rounds[i], rounds[end - 1]) : std::to_string(rounds[i]);
    i = end - i > 2 ? end : i + 1;
  }
  return text.empty() ? "none" : text;
}

std::string witness_words(Notion notion, const std::string& witness) {
  const bool names_belief = notion == Notion::self_confirming_class && !witness.empty();
  return names_belief ? "believes the other to be " + witness : witness;
}

std::string how_words(Notion notion, const Gap& gap) {
  std::string text = witness_words(notion, witness_text(gap));
  if (text.empty()) text = gap.gain > 0 ? "-" : gap.bounded() ? "none was found that gains" : "no deviation gains";
  if (!gap.tried.empty()) return fmt::format("{} (a lower bound: {})", text, gap.tried);
  if (gap.depth) return fmt::format("{} (a lower bound: depth {})", text, *gap.depth);
  return gap.exact || gap.residual == 0 ? text : fmt::format("{} (exact to {:.1g})", text, gap.residual);
}

std::vector<std::string> binding_words(const Threshold& threshold, const std::string& policy,
                                       const std::string& opponent) {
  std::vector<std::string> words;
  const auto texts = to_exact_texts(threshold.set);
  for (std::size_t i = 0; i < texts.size(); ++i) {
    const auto& interval = threshold.set.intervals()[i];
    for (const std::size_t e : {0U, 1U}) {
      const auto& end = e == 0 ? interval.low : interval.high;
      if (end.constraint == DiscountSet::no_constraint) continue;
      const Binding& binding = threshold.bindings[end.constraint];
      words.push_back(fmt::format("at {}: {}, {}, plays {} {}", texts[i][e], side_text(policy, opponent, binding.side),
                                  binding.history.empty() ? "in round 1" : "after " + history_text(binding.history),
                                  to_char(binding.deviation), then_words(binding.then)));
    }
  }
  return words;
}

}  // namespace folk::tools
