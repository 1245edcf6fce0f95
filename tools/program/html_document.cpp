#include <folk/tools/program/html_document.h>

namespace folk::tools {

/// Nothing but system fonts; every colour of a word comes with a sign, for readers who cannot tell colours apart.
const char* const report_style = R"(
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

std::string html_document(const std::string& title, const std::string& style, const Html& body) {
  const Html head = Html::markup(
                        "<meta charset=\"utf-8\">\n<meta name=\"viewport\" content=\"width=device-width, "
                        "initial-scale=1\">\n") +
                    element("title", title) + "\n" + element("style", Html::markup(style)) + "\n";
  const Html whole = Html("\n") + element("head", Html("\n") + head) + "\n" + element("body", Html("\n") + body) + "\n";
  return "<!DOCTYPE html>\n" + element("html", whole, {{"lang", "en"}}).string() + "\n";
}

}  // namespace folk::tools
