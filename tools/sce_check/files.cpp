// The files that sce-check writes.

#include <folk/tools/sce_check/output.h>

#include <folk/analysis/pictures/drawing.h>
#include <folk/analysis/pictures/render.h>
#include <folk/games/text_file.h>
#include <folk/games/utf8.h>
#include <folk/strategies/machine_text.h>

#include <algorithm>
#include <cctype>

namespace folk::tools {

std::string extracted_name(const SceQuestion& question) {
  // The last part of a path, with what a name may hold.
  const std::string& policy = question.policy.name;
  std::string name = policy.starts_with("sct:") ? std::filesystem::path(policy.substr(4)).stem().string() : policy;
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  return name + "_extracted";
}

std::string machine_file(const SceQuestion& question, const ExtractedMachine& extracted) {
  const std::string name = extracted_name(question);
  return "# Plays as " + visible_text(question.policy.name) + " does, by sce-check --extract.\n" +
         write_machine(name, extracted.tried[extracted.chosen].machine);
}

void write_files(const std::filesystem::path& folder, const SceQuestion& question, const SceReport& report) {
  write_file(folder / "report.json", [&](std::ostream& out) { write_json(out, question, report, true); });
  write_file(folder / "report.html", html_page(question, report));
  if (!report.extracted) return;
  const std::string name = extracted_name(question);
  const Automaton& machine = report.extracted->tried[report.extracted->chosen].machine;
  write_file(folder / (name + ".machines"), machine_file(question, *report.extracted));
  write_file(folder / (name + ".dot"), to_dot(machine, {name, Sense::own_moves_its_own, 0}));
}

}  // namespace folk::tools
