#pragma once
// How every program of Folk runs: its options are read, what it throws becomes a line and an exit code.

#include <folk/tools/description/description.h>

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace folk::tools {

/// How a result is printed on stdout.
enum class Format { text, csv, json };

/// Options that all programs take beside their own: --format, --quiet, --help, --version.
struct Common {
  Format format = Format::text;
  bool quiet = false;
  std::string program{};  ///< its name
  std::string command{};  ///< the command line, as a shell would read it

  /// A line on stderr, the program's name first, unless --quiet is given.
  void note(std::string_view message) const;
};

/// Exit codes: done; a claim that was to be checked does not hold (for programs that check one); wrong usage; bad input
/// file; anything else.
enum ExitCode { done = 0, claim_fails = 1, wrong_usage = 2, bad_input_file = 3, failed = 4 };

/// Parses the command line, answers --help and --version, runs `body`, and turns whatever it throws into one line on
/// stderr and an exit code. `formats` lists the values --format may take, the default first; empty: no such option.
/// A verb that is a program of its own gets the rest of the line.
///
/// Two questions are for what is made of the description: "--man" prints its page, "--complete SHELL LINE" what may
/// follow (completion.h).
int run(int argc, char** argv, Program program, const std::vector<std::string>& formats,
        const std::function<int(const po::variables_map&, const Common&)>& body);

/// One line on stderr, the program's name first; of several ranks one says it.
void say(std::string_view program, std::string_view message);

/// The text value of an option that may be given once, or `fallback`.
std::string text_option(const po::variables_map& values, const char* name, std::string fallback = {});

/// A whole number from `low` to `high` out of an option's text. Throws UsageError naming the option.
std::uint64_t whole_option(const po::variables_map& values, const char* name, std::uint64_t fallback, std::uint64_t low,
                           std::uint64_t high);

/// The version line and what the build was made of.
std::string version_text(std::string_view program);

}  // namespace folk::tools
