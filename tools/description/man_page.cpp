#include <folk/tools/description/man_page.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <sstream>
#include <string_view>

namespace folk::tools {
namespace {

/// What an indented line may hold on a terminal of 80 columns.
constexpr std::size_t width = 68;

/// The name of the page: "mpe-train-collect".
std::string page_name(std::string name) {
  std::replace(name.begin(), name.end(), ' ', '-');
  return name;
}

/// Text that is printed as it stands: hyphens that a shell reads back, no line that begins as a request does.
std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) switch (c) {
      case '\\': result += "\\e"; break;
      case '-': result += "\\-"; break;
      case '^': result += "\\(ha"; break;
      case '~': result += "\\(ti"; break;
      case '`': result += "\\(ga"; break;
      case '\'': result += "\\(aq"; break;
      case '"': result += "\\(dq"; break;
      default: result += c;
    }
  return result.starts_with('.') ? "\\&" + result : result;
}

std::string bold(std::string_view text) { return "\\fB" + escaped(text) + "\\fR"; }
std::string italic(std::string_view text) { return "\\fI" + escaped(text) + "\\fR"; }

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// The usage, an alternative a line: " | " outside of parentheses parts them.
std::vector<std::string> alternatives(std::string_view usage) {
  std::vector<std::string> parts(1);
  int depth = 0;
  for (std::size_t i = 0; i < usage.size(); ++i) {
    depth += usage[i] == '(' ? 1 : usage[i] == ')' ? -1 : 0;
    if (depth == 0 && usage.substr(i, 3) == " | ") {
      parts.emplace_back();
      i += 2;
    } else {
      parts.back() += usage[i];
    }
  }
  return parts;
}

/// Paragraphs are filled; lines that are set in, "  curve  draws ...", are a list of words and what they do.
std::string summary_text(const std::string& summary) {
  std::string text;
  bool in_list = false;
  for (const auto& line : lines_of(summary)) {
    const auto end = line.find("  ", 2);
    const bool of_list = line.starts_with("  ") && end != std::string::npos;
    if (of_list) {
      text += fmt::format(".TP\n{}\n{}\n", bold(line.substr(2, end - 2)),
                          escaped(line.substr(line.find_first_not_of(' ', end))));
    } else {
      text += (in_list ? ".PP\n" : "") + escaped(line) + "\n";
    }
    in_list = of_list;
  }
  return text;
}

/// How the options describe a value, "SPEC (=classics)" or "[=FORMAT(=svg)]": its name, and what it is where it is left
/// out.
std::pair<std::string, std::string> name_and_default(const std::string& parameter) {
  const auto open = parameter.find("(=");
  if (open == std::string::npos) return {parameter, {}};
  const auto close = parameter.find(')', open);
  const std::string name = parameter.substr(0, open) + parameter.substr(close + 1);
  return {name.substr(0, name.find(' ')), parameter.substr(open + 2, close - open - 2)};
}

std::string option_text(const po::option_description& option) {
  std::string text = ".TP\n";
  const std::string shown = option.format_name();  // "-o [ --output ]" or "--output"
  if (shown.starts_with("-") && !shown.starts_with("--")) text += bold(shown.substr(0, 2)) + ", ";
  text += bold("--" + option.long_name());
  const auto [name, fallback] = name_and_default(option.format_parameter());
  if (!name.empty()) text += (name.starts_with('[') ? "" : " ") + italic(name);
  text += "\n" + escaped(option.description()) + "\n";
  if (!fallback.empty()) text += escaped(fmt::format("(default {})", fallback)) + "\n";
  return text;
}

/// A long command goes on in a new line before an option, as a shell reads it.
std::string example_text(std::string_view command) {
  std::string text;
  while (command.size() > width) {
    const auto cut = command.rfind(" -", width);
    if (cut == std::string_view::npos || cut == 0) break;
    text += escaped(command.substr(0, cut)) + " \\e\n    ";
    command.remove_prefix(cut + 1);
  }
  return text + escaped(command) + "\n";
}

/// All programs, and the verbs of this one, except for the page itself.
std::string see_also(const Program& program) {
  std::vector<std::string> pages;
  for (const auto& verb : program.verbs)
    if (verb.main) pages.push_back(page_name(program.name + " " + verb.name));
  for (const std::string other : {FOLK_PROGRAM_NAMES})
    if (other != program.name) pages.push_back(other);
  std::vector<std::string> shown;
  for (const auto& page : pages) shown.push_back(fmt::format("{}(1)", bold(page)));
  return fmt::format("{}\n", fmt::join(shown, ",\n"));
}

}  // namespace

std::string man_page(const Program& program) {
  const std::string name = page_name(program.name);
  std::string title = name;
  std::transform(title.begin(), title.end(), title.begin(), [](unsigned char c) { return std::toupper(c); });
  std::string page = fmt::format(".TH {} 1 \"\" \"Folk {}\" \"Folk: repeated games\"\n", title, FOLK_VERSION);
  page += ".nh\n.ad l\n.ss 12 0\n";
  page += fmt::format(".SH NAME\n{} \\- {}\n.SH SYNOPSIS\n", escaped(name), escaped(program.title));
  const char* next = "";
  for (const auto& usage : alternatives(program.usage)) {
    page += fmt::format("{}{} {}\n", next, bold(program.name), escaped(usage));
    next = ".br\n";
  }
  page += ".SH DESCRIPTION\n" + summary_text(program.summary) + ".SH OPTIONS\n";
  for (const auto& option : program.options.options()) page += option_text(*option);
  page += ".SH EXIT STATUS\n";
  for (const auto& [code, meaning] : exit_codes(program))
    page += fmt::format(".TP\n.B {}\n{}\n", code, escaped(meaning));
  page +=
      ".SH ENVIRONMENT\n.TP\n.B FOLK_DATA\nthe folder of the data that Folk ships, where it is not found from the "
      "program's own place\n";
  if (program.shares_work) page += ".TP\n.B FOLK_MPI=off\nranks of a launcher do not share the work\n";
  page += ".SH FILES\n.TP\n.I ../share/folk/policies\ntransformers: sct, sct\\-bayes, sct\\-plan\n";
  page +=
      ".TP\n.I ../share/folk/mpe\nplayers of the particle world\n.PP\nBoth as seen from the folder of the programs.\n";
  page += ".SH EXAMPLES\n.nf\n";
  for (const auto& example : program.examples) page += example_text(example);
  return page + ".fi\n.SH SEE ALSO\n" + see_also(program);
}

}  // namespace folk::tools
