#include <folk/games/criterion.h>
#include <folk/games/error.h>
#include <folk/strategies/names.h>
#include <folk/strategies/programs/program_rules.h>
#include <folk/strategies/quoted_text.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace folk {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds longest_wait = std::chrono::hours(24);

milliseconds parse_seconds(std::string_view text, const std::string& what) {
  const double number = parse_number(text, what, 0.001, seconds(longest_wait));
  return milliseconds(std::llround(1000 * number));
}

/// Where the quotes of a text end that begins with one; npos when they do not.
std::size_t end_of_quotes(std::string_view text) {
  for (std::size_t i = 1; i < text.size(); ++i) {
    if (text[i] == '\\')
      ++i;
    else if (text[i] == '"')
      return i;
  }
  return std::string_view::npos;
}

[[noreturn]] void refuse_form(std::string_view text) {
  throw UsageError(fmt::format(
      "'exec{}': expected exec:\"CMD\" or exec(\"CMD\";timeout=SECONDS;start=SECONDS;deterministic)", excerpt(text)));
}

void refuse_twice(bool twice, std::string_view setting) {
  if (twice) throw UsageError(fmt::format("exec: '{}' is given twice", setting));
}

ProgramRules parse_settings(std::string_view text) {
  ProgramRules rules;
  std::optional<milliseconds> answer;
  std::optional<milliseconds> first;
  while (!text.empty()) {  // it begins with a semicolon
    const auto end = std::min(text.find(';', 1), text.size());
    const std::string_view setting = trimmed(text.substr(1, end - 1));
    text.remove_prefix(end);
    if (setting == "deterministic") {
      refuse_twice(std::exchange(rules.deterministic, true), setting);
    } else if (setting.starts_with("timeout=")) {
      refuse_twice(answer.has_value(), "timeout");
      answer = parse_seconds(setting.substr(8), "exec: timeout in seconds");
    } else if (setting.starts_with("start=")) {
      refuse_twice(first.has_value(), "start");
      first = parse_seconds(setting.substr(6), "exec: start in seconds");
    } else {
      throw UsageError(fmt::format("exec: setting '{}': expected timeout=SECONDS, start=SECONDS or deterministic",
                                   excerpt(setting)));
    }
  }
  rules.answer = answer.value_or(rules.answer);
  rules.first_answer = first.value_or(std::max(rules.first_answer, rules.answer));
  return rules;
}

}  // namespace

void check_call(const ProgramCall& call) {
  const auto is_control = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; };
  if (call.command.find_first_not_of(' ') == std::string::npos)
    throw UsageError("exec: has no command; write exec:\"COMMAND\", as in exec:\"python3 player.py\"");
  if (std::any_of(call.command.begin(), call.command.end(), is_control))
    throw UsageError(
        fmt::format("exec: command '{}' has control characters; put it into a script", excerpt(call.command)));
  for (const milliseconds time : {call.rules.first_answer, call.rules.answer})
    if (time < milliseconds(1) || time > longest_wait)
      throw UsageError(fmt::format("exec: time-out of {} ms: expected 1 ms to a day", time.count()));
  if (call.rules.first_answer < call.rules.answer)
    throw UsageError(fmt::format("exec: start={} is less than timeout={}, what any answer has",
                                 seconds(call.rules.first_answer), seconds(call.rules.answer)));
}

ProgramCall parse_program_call(std::string_view text) {
  ProgramCall call;
  if (text.starts_with(':')) {
    call.command = unquoted(text.substr(1));
  } else {
    if (!text.starts_with("(\"") || !text.ends_with(')')) refuse_form(text);
    const std::string_view inside = text.substr(1, text.size() - 2);
    const auto end = end_of_quotes(inside);
    if (end == std::string_view::npos) refuse_form(text);
    const std::string_view settings = trimmed(inside.substr(end + 1));
    if (!settings.empty() && settings.front() != ';') refuse_form(text);
    call = {unquoted(inside.substr(0, end + 1)), parse_settings(settings)};
  }
  check_call(call);
  return call;
}

std::string to_string(const ProgramCall& call) {
  std::string escaped;
  for (const char c : call.command) {
    if (c == '"' || c == '\\') escaped += '\\';
    escaped += c;
  }
  constexpr ProgramRules usual;
  if (call.rules == usual) return fmt::format("exec:\"{}\"", escaped);
  std::string settings;
  if (call.rules.answer != usual.answer) settings += fmt::format(";timeout={}", seconds(call.rules.answer));
  if (call.rules.first_answer != std::max(usual.first_answer, call.rules.answer))
    settings += fmt::format(";start={}", seconds(call.rules.first_answer));
  if (call.rules.deterministic) settings += ";deterministic";
  return fmt::format("exec(\"{}\"{})", escaped, settings);
}

bool names_a_program(std::string_view name) { return name.starts_with("exec:") || name.starts_with("exec("); }

}  // namespace folk
