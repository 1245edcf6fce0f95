#include <folk/games/error.h>
#include <folk/games/rational.h>
#include <folk/strategies/machine_text.h>
#include <folk/strategies/names.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <optional>
#include <unordered_map>
#include <utility>

namespace folk {

namespace {

/// What is wrong, before it is known whether a file or a line of the program's own data is at fault.
struct Fault {
  std::size_t line;
  std::string what;
};

/// The words between two line ends or ';', without the comment.
struct Statement {
  static constexpr std::size_t most_words = 7;  // one more than any statement has

  std::size_t line = 0;
  std::size_t count = 0;
  std::array<std::string_view, most_words> words{};
};

Statement split_words(std::string_view text, std::size_t line) {
  Statement statement{line};
  constexpr std::string_view blanks = " \t\r";
  for (auto begin = text.find_first_not_of(blanks);
       begin != std::string_view::npos && statement.count < Statement::most_words;) {
    const auto end = std::min(text.find_first_of(blanks, begin), text.size());
    statement.words[statement.count++] = text.substr(begin, end - begin);
    begin = text.find_first_not_of(blanks, end);
  }
  return statement;
}

void refuse_control_characters(std::string_view text, std::size_t line) {
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if ((code < 0x20 && c != '\t') || code == 0x7f)
      throw Fault{line, fmt::format("control character 0x{:02x}; a machine file is plain text", code)};
  }
}

/// Calls `take` with each statement that is not empty.
template <class Take>
void for_each_statement(std::string_view text, Take take) {
  for (std::size_t line = 1; !text.empty(); ++line) {
    const auto end = std::min(text.find('\n'), text.size());
    std::string_view rest = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (rest.ends_with('\r')) rest.remove_suffix(1);
    refuse_control_characters(rest, line);
    rest = rest.substr(0, rest.find('#'));
    while (!rest.empty()) {
      const auto semicolon = std::min(rest.find(';'), rest.size());
      const Statement statement = split_words(rest.substr(0, semicolon), line);
      if (statement.count > 0) take(statement);
      rest.remove_prefix(std::min(semicolon + 1, rest.size()));
    }
  }
}

void check_name(std::string_view what, std::string_view name, std::size_t line) {
  if (name.size() > longest_name)
    throw Fault{line, fmt::format("the name '{}' of a {} is longer than {} characters; shorten it", excerpt(name), what,
                                  longest_name)};
  if (!std::all_of(name.begin(), name.end(), is_name_character))
    throw Fault{line, fmt::format("'{}' is no name of a {}; use {}", excerpt(name), what, own_name_characters)};
}

/// A roster reads "-x" as an option and "@x" as a file, and does not see '_' and '-'.
void check_machine_name(std::string_view name, std::size_t line) {
  check_name("machine", name, line);
  if (!is_letter_or_digit(name.front()))
    throw Fault{line, fmt::format("'{}' is no name of a machine; begin it with a letter or a digit", excerpt(name))};
}

void check_state_name(std::string_view name, std::size_t line) {
  check_name("state", name, line);
  if (name == "machine" || name == "start")
    throw Fault{
        line, fmt::format("'{}' is no name of a state here; expected 'start STATE' or a state's line", excerpt(name))};
}

double read_cooperation(std::string_view word, std::size_t line) {
  if (word == "C") return 1;
  if (word == "D") return 0;
  try {
    return parse_number(word, "move", 0, 1);
  } catch (const UsageError&) {
    throw Fault{line,
                fmt::format("move '{}': expected C, D or the probability of C, a number from 0 to 1", excerpt(word))};
  }
}

/// The states of one machine as they are listed; successors may be listed later, so that they are names until the end.
class Block {
public:
  void take(const Statement& statement) {
    const auto& words = statement.words;
    if (words[0] == "start" && statement.count == 2)
      take_start(words[1], statement.line);
    else
      take_state(statement);
  }

  bool empty() const { return states_.empty(); }

  /// `named`: the machine knows what its states are called.
  Automaton finish(bool named) const {
    std::vector<Automaton::Node> nodes;
    nodes.reserve(states_.size());
    for (const auto& state : states_) {
      Automaton::Node& node = nodes.emplace_back();
      node.cooperation = state.cooperation;
      for (std::size_t o = 0; o < 4; ++o) node.next[o] = find(state.next[o], state.line);
    }
    std::vector<std::string> names;
    if (named)
      for (const auto& state : states_) names.emplace_back(state.name);
    return Automaton(std::move(nodes), start_ ? find(start_->first, start_->second) : 0, std::nullopt,
                     std::move(names));
  }

private:
  struct Listed {
    std::size_t line;
    std::string_view name;
    double cooperation;
    std::array<std::string_view, 4> next;
  };

  void take_start(std::string_view name, std::size_t line) {
    check_name("state", name, line);
    if (start_) throw Fault{line, fmt::format("a second start; line {} gives the first", start_->second)};
    start_.emplace(name, line);
  }

  void take_state(const Statement& statement) {
    const auto& words = statement.words;
    const auto line = statement.line;
    check_state_name(words[0], line);
    if (statement.count != 4 && statement.count != 6)
      throw Fault{line,
                  fmt::format("state '{}': expected a move and two successors (on their C and D) or four (by own and "
                              "their move: CC CD DC DD)",
                              excerpt(words[0]))};
    if (states_.size() == most_written_states)
      throw Fault{line, fmt::format("more than {} states; use a smaller machine", most_written_states)};
    const auto [found, is_new] = index_.try_emplace(words[0], static_cast<std::uint32_t>(states_.size()));
    if (!is_new)
      throw Fault{line, fmt::format("state '{}' is already in line {}; rename one of them", excerpt(words[0]),
                                    states_[found->second].line)};
    Listed listed{line, words[0], read_cooperation(words[1], line), {words[2], words[3], words[2], words[3]}};
    if (statement.count == 6) listed.next = {words[2], words[3], words[4], words[5]};
    states_.push_back(listed);
  }

  std::uint32_t find(std::string_view name, std::size_t line) const {
    const auto found = index_.find(name);
    if (found == index_.end())
      throw Fault{line, fmt::format("unknown state '{}'; list it in this machine", excerpt(name))};
    return found->second;
  }

  std::vector<Listed> states_;
  std::unordered_map<std::string_view, std::uint32_t> index_;
  std::optional<std::pair<std::string_view, std::size_t>> start_;
};

/// A whole file: blocks that begin with "machine NAME".
class File {
public:
  void take(const Statement& statement) {
    if (statement.words[0] == "machine") {
      if (statement.count != 2) throw Fault{statement.line, "expected 'machine NAME', a name without blanks"};
      finish_block();
      begin(statement.words[1], statement.line);
    } else if (line_ == 0) {
      throw Fault{statement.line, fmt::format("'{}' stands before the first machine; begin a block with 'machine NAME'",
                                              excerpt(statement.words[0]))};
    } else {
      block_.take(statement);
    }
  }

  std::vector<NamedMachine> finish() {
    finish_block();
    if (machines_.empty()) throw Fault{1, "no machine in this file; begin a block with 'machine NAME'"};
    return std::move(machines_);
  }

private:
  void begin(std::string_view name, std::size_t line) {
    check_machine_name(name, line);
    const auto [earlier, is_new] = lines_.try_emplace(name_key(name), line);
    if (!is_new)
      throw Fault{line,
                  fmt::format("machine '{}' has the name of the one in line {} (case, _ and - do not count); rename "
                              "one of them",
                              excerpt(name), earlier->second)};
    name_ = name;
    line_ = line;
  }

  void finish_block() {
    if (line_ == 0) return;
    if (block_.empty())
      throw Fault{line_, fmt::format("machine '{}' has no state; list one as 'c C c c'", excerpt(name_))};
    machines_.push_back({std::string(name_), block_.finish(true)});
    block_ = {};
  }

  std::vector<NamedMachine> machines_;
  std::map<std::string, std::size_t> lines_;  // by key
  Block block_;
  std::string_view name_;
  std::size_t line_ = 0;
};

std::string writable_name(std::string_view name) {
  std::string result;
  for (const char c : name.substr(0, longest_name)) {
    if (is_name_character(c) && (!result.empty() || is_letter_or_digit(c)))
      result += c;
    else if (!result.empty() && result.back() != '_')
      result += '_';
  }
  // Only a '_' that replaces something is dropped at the end.
  if (!name.ends_with('_') && result.ends_with('_')) result.pop_back();
  return result.empty() ? "unnamed" : result;
}

char letter_of(double cooperation) { return cooperation == 1 ? 'c' : cooperation == 0 ? 'd' : 'm'; }

std::string text_of(double cooperation) {
  if (cooperation == 1) return "C";
  if (cooperation == 0) return "D";
  return fmt::format("{}", cooperation);
}

std::vector<std::string> state_names(const std::vector<Automaton::Node>& nodes) {
  std::map<char, std::size_t> used;
  std::vector<std::string> names;
  names.reserve(nodes.size());
  for (const auto& node : nodes) {
    const char letter = letter_of(node.cooperation);
    const auto number = ++used[letter];
    names.push_back(number == 1 ? std::string(1, letter) : fmt::format("{}{}", letter, number));
  }
  return names;
}

}  // namespace

std::vector<NamedMachine> read_machines(std::string_view text, const std::string& source) {
  constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
  if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
  try {
    File file;
    for_each_statement(text, [&](const Statement& statement) { file.take(statement); });
    return file.finish();
  } catch (const Fault& fault) {
    throw InputFileError(fmt::format("{}:{}: {}", excerpt(source, 1000), fault.line, fault.what));
  }
}

Automaton read_machine_line(std::string_view line) {
  try {
    Block block;
    for_each_statement(line, [&](const Statement& statement) { block.take(statement); });
    if (block.empty()) throw Fault{1, "it has no state; list one as 'c C c c'"};
    return block.finish(false);
  } catch (const Fault& fault) {
    throw UsageError(fmt::format("machine '{}': {}", excerpt(line), fault.what));
  }
}

std::string write_machine(const std::string& name, const Automaton& machine) {
  if (machine.beyond())
    throw UsageError(
        fmt::format("machine '{}' ends at a horizon and cannot be written as a finite one", excerpt(name)));
  const auto& nodes = machine.nodes();
  const auto names = state_names(nodes);
  std::size_t name_width = 0;
  std::size_t move_width = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    name_width = std::max(name_width, names[i].size());
    move_width = std::max(move_width, text_of(nodes[i].cooperation).size());
  }
  std::string text = fmt::format("machine {}\n", writable_name(name));
  auto out = std::back_inserter(text);
  if (machine.start() != 0) fmt::format_to(out, "start {}\n", names[machine.start()]);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const auto& next = nodes[i].next;
    const bool own_matters = next[0] != next[2] || next[1] != next[3];
    fmt::format_to(out, "{:<{}}  {:<{}} ", names[i], name_width, text_of(nodes[i].cooperation), move_width);
    for (std::size_t o = 0; o < (own_matters ? 4U : 2U); ++o)
      fmt::format_to(out, " {:<{}}", names[next[o]], name_width);
    text.erase(text.find_last_not_of(' ') + 1);
    text += '\n';
  }
  return text;
}

}  // namespace folk
