#include <folk/tools/mpe_train/study_page.h>
#include <folk/tools/program/html_document.h>

#include <fmt/format.h>

namespace folk::tools {
namespace {

constexpr const char* title = "Offline learners of the particle world";

/// Nothing but system fonts; every colour of a cell comes with a sign, for readers who cannot tell colours apart.
constexpr const char* style = R"(
:root { color-scheme: light dark; --paper: #fff; --ink: #1a1a1a; --quiet: #5a5a5a; --line: #d5d5d5; --rule: #999;
  --above: #116329; --below: #a40e26; }
@media (prefers-color-scheme: dark) {
  :root { --paper: #16181b; --ink: #e6e6e6; --quiet: #a3a7ab; --line: #3a3e42; --rule: #777; --above: #6fd08c;
    --below: #ff8f9d; }
}
body { margin: 0 auto; padding: 1rem; max-width: 72rem; background: var(--paper); color: var(--ink);
  font: 1rem/1.5 system-ui, sans-serif; -webkit-text-size-adjust: 100%; }
h1 { font-size: 1.5rem; line-height: 1.25; }
h2 { font-size: 1.25rem; margin-top: 2.5rem; border-bottom: 1px solid var(--rule); }
h3 { font-size: 1.1rem; margin: 2rem 0 .4rem; }
h4 { font-size: 1rem; margin: 1.2rem 0 .3rem; }
p, dd { max-width: 60rem; overflow-wrap: anywhere; }
dl { display: grid; grid-template-columns: max-content minmax(0, 1fr); gap: .15rem 1rem; margin: .6rem 0; }
dl.legend { font-size: .875rem; }
dt { color: var(--quiet); }
dd { margin: 0; }
.scroll { overflow-x: auto; margin: .4rem 0; }
table { border-collapse: collapse; font-size: .875rem; line-height: 1.35; }
th, td { text-align: left; vertical-align: top; padding: .25rem .7rem .25rem 0; border-bottom: 1px solid var(--line);
  font-variant-numeric: tabular-nums; white-space: nowrap; }
th { border-bottom: 2px solid var(--rule); vertical-align: bottom; }
small { font-size: .8em; color: var(--quiet); }
small.beside { display: block; }
.above { color: var(--above); }
.below { color: var(--below); }
.none { color: var(--quiet); }
.row { display: flex; flex-wrap: wrap; gap: 1rem; align-items: flex-start; margin: .6rem 0; }
figure { margin: 0; flex: 1 1 24rem; min-width: 0; max-width: 34rem; }
figure img { display: block; width: 100%; height: auto; background: #fff; border-radius: .3rem; }
summary { cursor: pointer; margin: .6rem 0; }
@media screen and (max-width: 40rem) {
  dl { grid-template-columns: minmax(0, 1fr); }
  dd { margin: 0 0 .4rem 1rem; }
}
@media print {
  :root { color-scheme: light; --paper: #fff; --ink: #000; --quiet: #444; }
  body { max-width: none; padding: 0; font-size: 9pt; }
  .scroll { overflow: visible; }
  figure, tr { break-inside: avoid; }
  h2, h3, h4 { break-after: avoid; }
}
)";

std::string budget_words(mpe::Budget budget) {
  switch (budget) {
    case mpe::Budget::smoke: return "smoke: a few steps to see that everything runs; no number here says anything";
    case mpe::Budget::small: return "small: smaller networks and fewer steps than the paper's, minutes a training";
    case mpe::Budget::paper: break;
  }
  return "paper: the networks and steps of the sources";
}

Html plan_list(const mpe::StudySettings& settings) {
  Html list;
  const auto add = [&](const Html& name, const Html& value) { list += element("dt", name) + element("dd", value); };
  add("budget", budget_words(settings.budget));
  add("data sets", fmt::format("{} transitions each", settings.transitions));
  add("training seeds", fmt::format("{} of each learner; one where the data are random", settings.seeds));
  add("episodes",
      fmt::format("{} a reported score, {} a choice of what to ask for, {} a forced belief; no two of these "
                  "share any",
                  settings.episodes, settings.selection_episodes, settings.intervention_episodes));
  return element("dl", list) + "\n";
}

Html reading_list() {
  Html list;
  for (const char* words : {
           "Each table is of one scenario and of the data that its learners learned from; a line is a learner, a "
           "column "
           "the prey that it meets.",
           "A cell is the mean over training seeds ± half of its 95 % interval (number of seeds); below it stands what "
           "the "
           "paper prints.",
           "▲ and ▼ mark scores above and below the paper's number by more than both intervals; all others may be the "
           "same.",
           "Learners whose training sees one prey are met by four others: what they lose there is what the paper is "
           "about.",
       })
    list += element("li", words) + "\n";
  return element("ul", Html("\n") + list) + "\n";
}

}  // namespace

std::string study_page(const mpe::StudyTables& main, const mpe::StudyTables& second, const mpe::StudySettings& settings,
                       const DrawnPictures& pictures) {
  Html body = heading(1, title);
  body += element("p",
                  "The comparison of Li, Guevara, Xie & Zhu (arXiv 2310.04579) done again: learners of recorded play "
                  "against preys that they may never have seen.") +
          "\n";
  body += plan_list(settings);
  body += heading(2, "What is done");
  body +=
      element("p", progress_words(main, second, settings) + "; numbers are trainings, or examinations of players.") +
      "\n";
  for (const auto* tables : {&main, &second})
    body += heading(4, data_title(*tables)) + progress_table(*tables, settings);
  if (!pictures.missing.empty()) body += element_of("p", "none", "No pictures: " + pictures.missing) + "\n";
  body += heading(2, "How to read it") + reading_list();
  body += data_section(main, pictures) + data_section(second, pictures);
  return html_document(title, style, body);
}

}  // namespace folk::tools
