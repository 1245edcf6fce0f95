#include <folk/tools/program/program.h>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <folk/games/error.h>
#include <folk/games/rational.h>
#include <folk/games/utf8.h>
#include <folk/strategies/names.h>
#include <folk/strategies/nearest_names.h>
#include <folk/tools/description/completion.h>
#include <folk/tools/description/man_page.h>
#include <folk/tools/description/value_names.h>
#include <folk/tools/program/launch.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <iostream>
#include <limits>
#include <new>
#include <optional>

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

namespace folk::tools {
namespace {

/// The command line in a form that a shell reads back.
std::string command_line(const std::string& program, int argc, char** argv) {
  constexpr std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_=+:,./@%";
  std::string line = program;
  for (int i = 1; i < argc; ++i) {
    const std::string_view word = argv[i];
    line += ' ';
    if (!word.empty() && word.find_first_not_of(plain) == std::string_view::npos) {
      line += word;
      continue;
    }
    line += '\'';
    for (const char c : word) line += c == '\'' ? std::string("'\\''") : std::string(1, c);
    line += '\'';
  }
  return line;
}

int complain(const Program& program, std::string_view message, ExitCode code) {
  std::cout.flush();
  say(program.name, message);
  return code;
}

/// Takes the arguments that no positional option wants, so that a message can name them. Nobody types this name.
constexpr const char* unexpected = "unexpected argument";

/// "--output --plot": the parser takes the second for the value of the first, its user forgot the value.
void refuse_options_as_values(const po::parsed_options& parsed, const po::options_description& options) {
  for (const auto& option : parsed.options) {
    const auto& tokens = option.original_tokens;
    if (option.position_key >= 0 || tokens.size() < 2 || tokens[1].substr(0, 2) != "--") continue;
    const std::string name = tokens[1].substr(2, tokens[1].find('=') - 2);
    if (options.find_nothrow(name, false) != nullptr)
      throw UsageError(
          fmt::format("{} has no value: '{}' follows; write '{} VALUE'", tokens[0], excerpt(tokens[1]), tokens[0]));
  }
}

/// A misspelt option, with what may have been meant.
std::string unknown_option_text(const po::unknown_option& error, const Program& program) {
  std::vector<NameCandidate> candidates;
  for (const auto& option : program.options.options())
    candidates.push_back({name_key(option->long_name()), "--" + option->long_name()});
  const auto near = nearest_names(error.get_option_name(), candidates);
  return fmt::format("{}{}; see {} --help", error.what(),
                     near.empty() ? "" : fmt::format(": did you mean {}?", fmt::join(near, ", ")), program.name);
}

po::variables_map parse(int argc, char** argv, const Program& program) {
  po::options_description options = program.options;
  options.add(program.arguments).add_options()(unexpected, po::value<std::vector<std::string>>(), "");
  po::positional_options_description positional = program.positional;
  if (positional.max_total_count() != std::numeric_limits<unsigned>::max()) positional.add(unexpected, -1);
  const auto parsed = po::command_line_parser(argc, argv)
                          .options(options)
                          .positional(positional)
                          .style(po::command_line_style::default_style & ~po::command_line_style::allow_guessing)
                          .run();
  refuse_options_as_values(parsed, options);
  po::variables_map values;
  po::store(parsed, values);
  po::notify(values);
  if (values.count(unexpected) != 0)
    throw UsageError(fmt::format("unexpected argument '{}': usage: {} {}",
                                 excerpt(values[unexpected].as<std::vector<std::string>>().front()), program.name,
                                 program.usage));
  return values;
}

/// A file that took the place of a standard stream that is closed would get what is meant for the stream.
void open_standard_streams() {
  for (int number = 0; number < 3; ++number)
    if (::fcntl(number, F_GETFD) < 0) {
      const int opened = ::open("/dev/null", number == 0 ? O_WRONLY : O_RDONLY);  // as before, it fails to be used
      if (opened >= 0 && opened != number) ::close(opened);
    }
}

/// Programs die without a word where it ends.
bool stack_is_large_enough() {
  constexpr rlim_t least = rlim_t{512} << 10U;
  rlimit limit{};
  return ::getrlimit(RLIMIT_STACK, &limit) != 0 || limit.rlim_cur >= least;
}

Format format_named(const std::string& name) {
  if (name == "csv") return Format::csv;
  if (name == "json") return Format::json;
  return Format::text;
}

int run_parsed(const Program& program, const std::string& command, const po::variables_map& values,
               const std::vector<std::string>& formats,
               const std::function<int(const po::variables_map&, const Common&)>& body) {
  if (values.count("help") != 0) {
    if (speaks()) std::cout << help_text(program);
    return done;
  }
  if (values.count("version") != 0) {
    if (speaks()) std::cout << version_text(program.name);
    return done;
  }
  Common common;
  common.quiet = values.count("quiet") != 0;
  common.program = program.name;
  common.command = command;
  if (!formats.empty()) {
    const auto name = values["format"].as<std::string>();
    if (std::find(formats.begin(), formats.end(), name) == formats.end())
      throw UsageError(fmt::format("--format '{}': expected {}", excerpt(name), fmt::join(formats, ", ")));
    common.format = format_named(name);
  }
  join_ranks(command);
  return body(values, common);
}

/// What is made of the description alone, where the first word asks for it; nothing for all that users type.
std::optional<std::string> described(const Program& program, const std::vector<std::string>& formats, int argc,
                                     char** argv) {
  const std::string_view question = argc > 1 ? argv[1] : "";
  if (question == "--man") return man_page(program);
  if (question == "--complete" && argc > 3)
    return completions(program, formats, argv[2], argv[3], argc > 4 ? argv[4] : "");
  return std::nullopt;
}

/// The verb with which the command line begins, or the one that is to be completed, if it is a program of its own.
const Verb* program_named(const Program& program, int argc, char** argv) {
  std::string word = argc > 1 ? argv[1] : "";
  if (word == "--complete" && argc > 3) word = verb_of_line(argv[3]);
  for (const auto& verb : program.verbs)
    if (verb.main && verb.name == word) return &verb;
  return nullptr;
}

/// Says what was thrown, and which exit code that is.
int complain_about(const std::exception_ptr& failure, const Program& program) {
  try {
    std::rethrow_exception(failure);
  } catch (const po::unknown_option& error) {
    return complain(program, unknown_option_text(error, program), wrong_usage);
  } catch (const po::error& error) {
    return complain(program, fmt::format("{}; see {} --help", error.what(), program.name), wrong_usage);
  } catch (const UsageError& error) {
    return complain(program, error.what(), wrong_usage);
  } catch (const InputFileError& error) {
    return complain(program, error.what(), bad_input_file);
  } catch (const std::filesystem::filesystem_error& error) {  // its own words are a call and two paths, whole
    return complain(program, fmt::format("{}: {}", excerpt(error.path1().string(), 1000), error.code().message()),
                    failed);
  } catch (const std::bad_alloc&) {
    return complain(program, "not enough memory for this", failed);
  } catch (const std::exception& error) {
    return complain(program, error.what(), failed);
  }
}

}  // namespace

int run(int argc, char** argv, Program program, const std::vector<std::string>& formats,
        const std::function<int(const po::variables_map&, const Common&)>& body) {
  if (const Verb* verb = program_named(program, argc, argv)) {
    const int passed = std::string_view(argv[1]) == verb->name ? 1 : 0;
    return verb->main(argc - passed, argv + passed);
  }
  // A reader that goes away (| head), a dead player, a limit of file sizes show as a failed write, not as a signal.
  for (const int number : {SIGPIPE, SIGXFSZ}) std::signal(number, SIG_IGN);
  open_standard_streams();
  if (!stack_is_large_enough())
    return complain(program, "the limit of the stack is too low to work with; raise it: ulimit -s 1024", failed);
  std::ios::sync_with_stdio(false);
  if (program.shares_work) share_work();
  int code = failed;
  std::exception_ptr failure;
  try {
    auto add = program.options.add_options();
    if (!formats.empty()) {
      const std::string text = fmt::format("how the result is printed: {}", fmt::join(formats, ", "));
      add("format", po::value<std::string>()->default_value(formats.front()), text.c_str());
    }
    add("quiet", "no banner, no progress, no warnings on stderr");
    add("help,h", "this text");
    add("version,V", "version and build");
    name_values(program.name, program.options);
    if (const auto text = described(program, formats, argc, argv)) {
      std::cout << *text;
      code = done;
    } else {
      code = run_parsed(program, command_line(program.name, argc, argv), parse(argc, argv, program), formats, body);
    }
    std::cout.flush();
    if (const int reason = errno; !std::cout && reason != EPIPE)
      code = complain(program, fmt::format("standard output cannot be written: {}", std::strerror(reason)), failed);
  } catch (...) {
    failure = std::current_exception();
    code = complain_about(failure, program);
  }
  return leave_ranks(code, failure);
}

void Common::note(std::string_view message) const {
  if (!quiet) say(program, message);
}

void say(std::string_view program, std::string_view message) {
  if (!speaks()) return;
  std::string text(message);
  std::replace(text.begin(), text.end(), '\n', ' ');
  const std::string line = fmt::format("{}: {}\n", program, visible_text(text));
  std::fwrite(line.data(), 1, line.size(), stderr);  // a stderr that is closed or full stops nothing
}

std::string text_option(const po::variables_map& values, const char* name, std::string fallback) {
  return values.count(name) != 0 ? values[name].as<std::string>() : std::move(fallback);
}

std::uint64_t whole_option(const po::variables_map& values, const char* name, std::uint64_t fallback, std::uint64_t low,
                           std::uint64_t high) {
  if (values.count(name) == 0) return fallback;
  return parse_whole_number(values[name].as<std::string>(), fmt::format("--{}", name), low, high);
}

std::string version_text(std::string_view program) {
  return fmt::format("{} (Folk {}), {} {}\n", program, FOLK_VERSION,
#if defined(__clang__)
                     "clang", __clang_version__
#else
                     "g++", __VERSION__
#endif
  );
}

}  // namespace folk::tools
