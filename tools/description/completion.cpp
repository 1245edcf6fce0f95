#include <folk/tools/description/completion.h>

#include <folk/tools/description/candidate.h>
#include <folk/tools/description/spec_candidates.h>
#include <folk/tools/description/typed_line.h>
#include <folk/tools/description/value_names.h>

#include <folk/mpe/players/names.h>

#include <algorithm>
#include <utility>

namespace folk::tools {
namespace {

std::string before_last(std::string_view text, char separator) {
  const auto at = text.rfind(separator);
  return std::string(at == std::string_view::npos ? "" : text.substr(0, at + 1));
}

std::vector<Candidate> criteria(std::string_view prefix, std::string_view begun) {
  std::vector<Candidate> candidates;
  add_beginning_with(candidates, prefix, begun,
                     {{"finite:", "T: the sum over T rounds", false},
                      {"discounted:", "d: normalised by 1-d", false},
                      {"mean", "the mean in the long run"},
                      {"ending:", "p: the expected sum where each round is the last with p", false}});
  return candidates;
}

/// T=, R=, P=, S=, those that are not given yet.
std::vector<Candidate> payoffs(std::string_view prefix, std::string_view begun) {
  const std::string given = before_last(begun, ',');
  std::vector<Candidate> left;
  for (const auto& [name, meaning] : {std::pair{"T=", "temptation: D against C"},
                                      {"R=", "reward: C against C"},
                                      {"P=", "punishment: D against D"},
                                      {"S=", "the sucker's: C against D"}})
    if (given.find(name) == std::string::npos) left.push_back({name, meaning, false});
  std::vector<Candidate> candidates;
  add_beginning_with(candidates, std::string(prefix) + given, begun.substr(given.size()), left);
  return candidates;
}

/// Players of the particle world by name, after a comma too, and policy files.
std::vector<Candidate> players(std::string_view prefix, std::string_view begun, mpe::Side side) {
  const std::string given = before_last(begun, ',');
  const std::string before = std::string(prefix) + given;
  std::vector<Candidate> names;
  for (const auto& name : mpe::known_names(side)) {
    const std::string literal(literal_part(name));
    names.push_back({literal, literal == name ? "" : name, literal == name});
  }
  std::vector<Candidate> candidates;
  add_beginning_with(candidates, before, begun.substr(given.size()), names);
  const auto files = path_candidates(before, begun.substr(given.size()));
  candidates.insert(candidates.end(), files.begin(), files.end());
  return candidates;
}

/// The values of an option, or of a word that stands for one, after `prefix` in its word.
std::vector<Candidate> values(const Program& program, const std::vector<std::string>& formats, const std::string& name,
                              std::string_view prefix, std::string_view begun) {
  auto words = name == "format" ? formats : value_words(program.name, name);
  if (!words.empty()) {
    std::vector<Candidate> all;
    for (auto& own : words) all.push_back({std::move(own)});
    std::vector<Candidate> candidates;
    add_beginning_with(candidates, prefix, begun, all);
    return candidates;
  }
  const std::string kind = value_name(program.name, name);
  if (kind == "CRITERION") return criteria(prefix, begun);
  if (kind == "T=,R=,P=,S=") return payoffs(prefix, begun);
  if (kind == "PLAYER") return players(prefix, begun, name == "prey" ? mpe::Side::prey : mpe::Side::predators);
  if (kind == "FILE" || kind == "DIR")
    return path_candidates(prefix, begun, kind == "DIR" ? PathKind::folder : PathKind::file);
  if (kind != "SPEC" || !program.registry) return {};
  auto candidates = spec_candidates(program.registry(), begun);
  for (auto& candidate : candidates) candidate.text.insert(0, prefix);
  return candidates;
}

std::vector<Candidate> options(const Program& program, std::string_view begun) {
  std::vector<Candidate> all;
  for (const auto& option : program.options.options())
    all.push_back({"--" + option->long_name(), option->description()});
  std::vector<Candidate> candidates;
  add_beginning_with(candidates, "", begun, all);
  return candidates;
}

/// The option whose value the next word is: "--rounds", "-o"; null for any other word.
const po::option_description* awaiting_value(const Program& program, const std::string& word) {
  for (const auto& option : program.options.options()) {
    const std::string shown = option->format_name();  // "-o [ --output ]" or "--output"
    const bool named = word == "--" + option->long_name() || (word.size() == 2 && shown.starts_with(word + " "));
    if (named && option->semantic()->min_tokens() > 0) return option.get();
  }
  return nullptr;
}

/// What a word that is neither an option nor its value may be: a verb, or what stands in its place on the line.
std::vector<Candidate> arguments(const Program& program, const std::vector<std::string>& formats,
                                 const std::vector<std::string>& before, const std::string& word) {
  std::size_t place = 0;
  for (std::size_t i = 0; i < before.size(); ++i)
    if (awaiting_value(program, before[i]) != nullptr)
      ++i;
    else if (!before[i].starts_with("-"))
      ++place;
  if (place == 0 && !program.verbs.empty()) {
    std::vector<Candidate> verbs;
    for (const auto& verb : program.verbs) verbs.push_back({verb.name, verb.title});
    std::vector<Candidate> candidates;
    add_beginning_with(candidates, "", word, verbs);
    return candidates;
  }
  if (place >= program.positional.max_total_count()) return options(program, word);
  return values(program, formats, program.positional.name_for_position(static_cast<unsigned>(place)), "", word);
}

std::vector<Candidate> candidates_for(const Program& program, const std::vector<std::string>& formats,
                                      std::vector<std::string> words) {
  const std::string word = words.back();
  words.pop_back();
  const auto own = 1 + std::count(program.name.begin(), program.name.end(), ' ');  // "mpe-train collect" are two
  words.erase(words.begin(), words.begin() + std::min(own, std::ssize(words)));
  if (!words.empty())
    if (const auto* option = awaiting_value(program, words.back()))
      return values(program, formats, option->long_name(), "", word);
  if (const auto sign = word.find('='); word.starts_with("--") && sign != std::string::npos)
    return values(program, formats, word.substr(2, sign - 2), word.substr(0, sign + 1),
                  std::string_view(word).substr(sign + 1));
  if (word.starts_with("-")) return options(program, word);
  return arguments(program, formats, words, word);
}

/// As it stands in a word of bash, within the quotation mark that is open or outside of any.
std::string quoted_for_bash(std::string_view text, char quote) {
  if (quote == '\'') return std::string(text);
  const std::string_view special = quote == '"' ? "\"$`\\" : " \t\"'\\$`&|;<>()*?[]!{}#";
  std::string result;
  for (const char c : text) {
    if (special.find(c) != std::string_view::npos) result += '\\';
    result += c;
  }
  return result;
}

/// How much of a word bash leaves as it is: all up to the last of the characters at which it breaks words, which stays
/// with what is before it, but for @.
std::size_t kept_by_bash(const TypedLine& line, std::string_view breaks) {
  if (line.quote != '\0') return 0;
  const std::string& word = line.last_as_typed;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < word.size(); ++i)
    if (word[i] == '\\')
      ++i;
    else if (word[i] != '\'' && word[i] != '"' && breaks.find(word[i]) != std::string_view::npos)
      kept = word[i] == '@' ? i : i + 1;
  return kept;
}

/// True where the shell would begin a new word after a candidate that stands alone, or close the quotation mark,
/// although more of the word follows.
bool ends_a_word(const Candidate& candidate, std::string_view shell, char quote) {
  if (candidate.complete || candidate.text.empty()) return false;
  const char last = candidate.text.back();
  return last == '(' || (shell == "bash" && quote != '\0') ||
         (shell == "fish" && std::string_view("/=:,").find(last) == std::string_view::npos);
}

/// What stands beside such a candidate, so that it does not stand alone: "memory(X,Y)" beside "memory(", else dots.
std::string what_follows(const Candidate& candidate) {
  if (!candidate.text.ends_with('(')) return candidate.text + "...";
  const std::string item = candidate.meaning.substr(0, candidate.meaning.find(')') + 1);
  return candidate.text.substr(0, candidate.text.size() - literal_part(item).size()) + item;
}

}  // namespace

std::string completions(const Program& program, const std::vector<std::string>& formats, std::string_view shell,
                        std::string_view line, std::string_view breaks) {
  const TypedLine typed = typed_line(line);
  auto candidates = candidates_for(program, formats, typed.words);
  if (candidates.size() == 1 && ends_a_word(candidates.front(), shell, typed.quote))
    candidates.push_back({what_follows(candidates.front())});
  std::string text;
  for (const auto& [word, meaning, complete] : candidates) {
    if (shell == "bash") {
      const std::string quoted = quoted_for_bash(word, typed.quote);
      text += quoted.substr(std::min(kept_by_bash(typed, breaks), quoted.size()));
    } else {
      text += word;
    }
    if (complete && shell != "fish" && (shell != "bash" || typed.quote == '\0')) text += ' ';
    if (shell != "bash") text += '\t' + meaning;
    text += '\n';
  }
  return text;
}

std::string verb_of_line(std::string_view line) {
  const auto words = typed_line(line).words;
  return words.size() > 2 ? words[1] : "";
}

}  // namespace folk::tools
