#include <folk/python/bindings/messages.h>

#include <algorithm>
#include <regex>
#include <string>

namespace folk::python {
namespace {

/// "epsilon-belief" as "epsilon_belief"; a word of Python has one more "_" behind it.
std::string argument(std::string option) {
  if (option == "class" || option == "from") return option + "_";
  std::replace(option.begin(), option.end(), '-', '_');
  return option;
}

}  // namespace

std::string in_python(const std::string& message) {
  // What a message begins with has a value where that stands before a colon ("--class sct: no machine is in it"); what
  // is met later, where the value is quoted, a number, a placeholder (N, SPEC) or the last word in brackets. Else the
  // option is spoken of. Before it stands a program, or nothing that could be a name.
  static const std::regex first("^--([a-z-]+) (?=[^ ]+:(?: |$))");
  static const std::regex option(
      "((?:(?:ipd|sce|sct|mpe)-[a-z]+|strategy-graph|payoff-region) |^|[ (])"
      "--([a-z]+(?:-[a-z]+)*)"
      "(?:=| (?=['0-9.A-Z]|-[0-9.]|[^ ]+\\)))?");
  const std::string joined = std::regex_replace(message, first, "--$1=");
  std::string text;
  auto rest = joined.cbegin();
  for (std::sregex_iterator found(joined.begin(), joined.end(), option), end; found != end; ++found) {
    const auto& match = *found;
    text.append(rest, match[0].first);
    text += match[1].length() > 1 ? match.str() : match.str(1) + argument(match.str(2)) + "=";
    rest = match[0].second;
  }
  return text.append(rest, joined.cend());
}

}  // namespace folk::python
