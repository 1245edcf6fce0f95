// The tables of sce-check's page that compare notions and opponents.

#include <folk/tools/sce_check/sections.h>
#include <folk/tools/sce_check/words.h>

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <vector>

namespace folk::tools {
namespace {

/// A column of the table of opponents.
struct Column {
  std::string heading;
  std::function<bool(const OpponentReport&)> known;
  std::function<Html(const OpponentReport&)> cell;
  std::string css_class = "number";
};

std::string short_title(Notion notion) {
  switch (notion) {
    case Notion::nash: return "Nash";
    case Notion::subgame_perfect: return "subgame perfect";
    case Notion::self_confirming_unrestricted: return "SCE, free beliefs";
    case Notion::self_confirming_class: return "SCE, class";
    case Notion::self_confirming_own: return "SCE, own beliefs";
    case Notion::beliefs: return "beliefs";
  }
  return "?";
}

Column gap_column(Notion notion, const SceReport& report) {
  ColumnForm form;
  for (const auto& one : report.opponents) {
    form.add(gap_of(one.gaps.first, notion));
    if (notion != Notion::self_confirming_own) form.add(gap_of(one.gaps.second, notion));
  }
  const auto known = [notion](const OpponentReport& one) {
    return gap_of(one.gaps.first, notion) || gap_of(one.gaps.second, notion);
  };
  const auto cell = [notion, form](const OpponentReport& one) {
    const auto& theirs = gap_of(one.gaps.second, notion);
    std::string text = form.text(gap_of(one.gaps.first, notion));
    // The other side holds no beliefs of its own that are known.
    if (notion != Notion::self_confirming_own) text += " / " + form.text(theirs);
    return sign_of(one.verdicts[place_of(notion)], absence_words(notion, one.belief.has_value())) + " " + text;
  };
  return {short_title(notion), known, cell};
}

Column threshold_column(const std::string& heading, std::optional<Threshold> Thresholds::*notion) {
  const auto known = [notion](const OpponentReport& one) { return one.thresholds && (*one.thresholds.*notion); };
  const auto cell = [known, notion](const OpponentReport& one) {
    return Html(known(one) ? to_readable_text((*one.thresholds.*notion)->set) : std::string("-"));
  };
  return {heading, known, cell, "long"};
}

Column belief_column(const std::string& heading, std::function<std::string(const BeliefConsistency&)> text) {
  return {heading, [](const OpponentReport& one) { return one.belief.has_value(); },
          [text = std::move(text)](const OpponentReport& one) { return Html(one.belief ? text(*one.belief) : "-"); }};
}

void add_belief_columns(std::vector<Column>& columns) {
  columns.push_back(belief_column("beliefs right", [](const auto& belief) { return share_text(belief.accuracy()); }));
  columns.push_back(
      belief_column("farthest from truth", [](const auto& belief) { return measure_text(belief.largest_distance); }));
  columns.push_back(belief_column("right from round", [](const auto& belief) {
    return belief.settled_from() ? std::to_string(*belief.settled_from()) : std::string("never");
  }));
  columns.push_back(
      {"moves changed by belief C / D", [](const OpponentReport& one) { return one.effect.has_value(); },
       [](const OpponentReport& one) {
         return Html(one.effect ? fmt::format("{} / {}", one.effect->changed_by_c, one.effect->changed_by_d) : "-");
       }});
}

std::vector<Column> columns_of(const SceReport& report) {
  std::vector<Column> columns;
  ColumnForm scores;
  for (const auto& one : report.opponents)
    for (const double score : {one.own_score, one.their_score}) scores.add(score);
  columns.push_back({"score own : theirs", [](const OpponentReport&) { return true; },
                     [scores](const OpponentReport& one) {
                       return Html(scores.text(one.own_score) + " : " + scores.text(one.their_score));
                     }});
  add_belief_columns(columns);
  for (const Notion notion : all_notions)
    if (notion != Notion::beliefs) columns.push_back(gap_column(notion, report));
  columns.push_back(threshold_column("Nash for d in", &Thresholds::nash));
  columns.push_back(threshold_column("perfect for d in", &Thresholds::subgame_perfect));
  columns.push_back(threshold_column("SCE for d in", &Thresholds::self_confirming_unrestricted));
  std::erase_if(columns, [&](const Column& column) {
    return std::none_of(report.opponents.begin(), report.opponents.end(), column.known);
  });
  return columns;
}

}  // namespace

std::string opponent_id(std::size_t opponent) { return fmt::format("opponent-{}", opponent + 1); }

Html verdict_table(const Certificates& verdicts, const std::array<std::string, all_notions.size()>* worst,
                   bool believes) {
  std::vector<std::string> headings{"claim", "verdict", "gain", "shown by"};
  std::vector<std::string> classes{"claim", "verdict", "number", "long"};
  if (worst != nullptr) {
    headings.insert(headings.begin() + 3, "worst opponent");
    classes.insert(classes.begin() + 3, "name");
  }
  HtmlTable table(headings, classes);
  for (std::size_t n = 0; n < all_notions.size(); ++n) {
    const Notion notion = all_notions[n];
    const auto& verdict = verdicts[n];
    const Html claim = element("b", std::string(title_of(notion))) + " " + element("small", meaning_of(notion));
    std::vector<Html> row{claim, word_of(verdict, absence_words(notion, believes)),
                          verdict ? Html(margin_text(notion, *verdict)) : Html("-"),
                          verdict ? Html(witness_words(notion, verdict->witness)) : Html()};
    // Where a claim is certified for all of them, none is worse than another.
    const bool certified = verdict && verdict->verdict == Verdict::certified;
    if (worst != nullptr) row.insert(row.begin() + 3, Html(certified ? "-" : (*worst)[n]));
    table.add(row);
  }
  return table.html();
}

Html settlement_section(const SceReport& report) {
  std::vector<std::string> headings{"opponent"};
  std::vector<std::string> classes{"name"};
  for (const Notion notion : all_notions) {
    headings.push_back(short_title(notion));
    classes.emplace_back("number");
  }
  HtmlTable table(headings, classes);
  const auto add = [&](const std::string& name, const SettledNotions& notions) {
    std::vector<Html> row{Html(name)};
    for (const auto& notion : notions) row.emplace_back(settled_text(notion));
    table.add(row);
  };
  for (std::size_t i = 0; i < report.opponents.size(); ++i)
    add(report.opponents[i].opponent, report.settlement->pairs[i]);
  if (report.opponents.size() > 1) add("all of them", report.settlement->all);
  return heading(2, "From which round on it holds for good") +
         paragraph(
             "The least round from which on, and from every later one, a claim is not refuted, seen from there "
             "after what was really played; ?: it is not certified either.") +
         table.html();
}

Html opponent_table(const SceReport& report) {
  const auto columns = columns_of(report);
  std::vector<std::string> headings{"opponent"};
  std::vector<std::string> classes{"name"};
  for (const auto& column : columns) {
    headings.push_back(column.heading);
    classes.emplace_back(column.css_class);
  }
  HtmlTable table(headings, classes);
  for (std::size_t i = 0; i < report.opponents.size(); ++i) {
    std::vector<Html> row{link(opponent_id(i), report.opponents[i].opponent)};
    for (const auto& column : columns) row.push_back(column.cell(report.opponents[i]));
    table.add(row);
  }
  return table.html();
}

}  // namespace folk::tools
