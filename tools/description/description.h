#pragma once
// A program as data: what its help, its page for man and the completion of its command lines are made of.

#include <folk/strategies/registry.h>
#include <boost/program_options.hpp>

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace folk::tools {

namespace po = boost::program_options;

/// A first word that decides what the rest of a command line is: "collect" of mpe-train.
struct Verb {
  std::string name;
  std::string title;                               ///< what it does, in a few words
  std::function<int(int argc, char** argv)> main;  ///< a program of its own, its name in argv[0]; empty: a plain word
};

/// A program as its help text shows it.
struct Program {
  std::string name;                   ///< "ipd-match"
  std::string title;                  ///< what it is, in a few words: "one match, move by move"
  std::string usage;                  ///< "A B [options]"
  std::string summary;                ///< what it does, a sentence or two
  std::vector<std::string> examples;  ///< whole command lines
  std::string claim{};                ///< what exit code 1 says, for programs that check something
  po::options_description options{"Options"};
  po::options_description arguments{};  ///< what the positional names below stand for; not in the help text
  po::positional_options_description positional{};
  std::vector<Verb> verbs{};
  std::function<Registry()> registry{};  ///< the strategies that a SPEC may name; empty: it takes none
  bool shares_work = false;  ///< where a launcher of MPI started several ranks of it, they do its work together
};

/// The exit codes that the program may end with, and what they say.
std::vector<std::pair<int, std::string>> exit_codes(const Program& program);

/// What --help prints.
std::string help_text(const Program& program);

}  // namespace folk::tools
