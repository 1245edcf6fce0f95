#pragma once
// Every strategy that has a name, and the reading of rosters.

#include <folk/games/payoffs.h>
#include <folk/games/text_file.h>
#include <folk/strategies/names.h>
#include <folk/strategies/pool.h>
#include <folk/strategies/strategy.h>

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace folk {

/// What the registry knows of a strategy or a family of strategies before it is made.
struct Description {
  std::string name;                  ///< "tit_for_tat", or with its parameters: "gtft(q)"
  std::vector<std::string> aliases;  ///< other names in the literature, matched like the name itself
  std::string behaviour;             ///< what it plays, in one line
  std::string reference;             ///< who described it, where
  std::string elsewhere{};           ///< who means another strategy by the name, and what that one is called here
};

/// Makes a strategy from its full name; the text between the parentheses is `arguments`.
using NamedMaker = std::function<Strategy(const std::string& name, std::string_view arguments, const Payoffs&)>;

/// Makes all strategies that an item of a roster stands for, in order.
using GroupMaker = std::function<std::vector<Strategy>(std::string_view item, const Payoffs&)>;

/// Makes the family of these arguments, "1,2" of "memory(1,2)".
using FamilyMaker = std::function<Family(std::string_view arguments)>;

/// Takes some of the strategies of a SPEC that stands among its arguments, "SPEC;40": `read` gives what SPEC names.
using SelectionMaker =
    std::function<Pool(std::string_view arguments, const std::function<Pool(std::string_view spec)>& read)>;

/// Gives the text of a file that a roster names.
using FileReader = std::function<std::string(const std::string& path)>;

/// Names of strategies, families, rosters, and prefixes like "@" and "exec:".
/// Names are matched without regard to case, blanks, '_' and '-'.
class Registry {
public:
  /// All strategies, families and rosters of Folk itself, "@FILE" and "exec:CMD" included. `read` gets what stands for
  /// FILE: a program may take "-" for its standard input, which a library leaves alone.
  static Registry standard(FileReader read = read_text_file);

  /// One strategy whose whole name is known, with its aliases. A name with "(...)" takes arguments.
  /// Throws std::logic_error when one of the names is taken.
  void add(Description description, NamedMaker make);

  /// Strategies whose names have a form (mem12_ccCDCDDCDD): `make` returns nothing where the name is not of the form.
  void add_form(Description description,
                std::function<std::optional<Strategy>(std::string_view name, const Payoffs&)> make);

  /// A comma list of names under one name: "classics".
  void add_roster(Description description, std::string members);

  /// A family with arguments: "memory(1,2)".
  void add_family(Description description, FamilyMaker make);

  /// A choice among other strategies: "sample(SPEC;40)".
  void add_selection(Description description, SelectionMaker make);

  /// Items that begin with `prefix`; what follows is handed on untouched, case and all ("exec:", "@", "sct:").
  void add_prefix(Description description, std::string prefix, GroupMaker make);

  /// The single strategy of this name; LABEL=NAME gives it another one. Throws UsageError, naming the nearest names,
  /// when there is none or several.
  Strategy make(std::string_view name, const Payoffs& payoffs = {}) const;

  /// All strategies of a comma list of names, rosters, families, samples, genotypes, @file, exec:"CMD"; LABEL= before
  /// an item that stands for one strategy renames it. Commas inside () or quotes do not split. What rosters and
  /// families share is there once. Throws UsageError on an unknown or repeated name and on an empty roster.
  std::vector<Strategy> roster(std::string_view spec, const Payoffs& payoffs = {}) const;

  /// Everything listed, in the order of its adding.
  const std::vector<Description>& strategies() const { return strategies_; }
  const std::vector<Description>& groups() const { return groups_; }

  /// What is known of the strategy, roster or family that `name` stands for, "gtft(0.3)" and mem12_ccCDCDDCDD included.
  /// A label says nothing about it. Throws UsageError for an unknown name.
  const Description& describe(std::string_view item) const;

private:
  struct Named {
    std::size_t description;
    bool takes_arguments;
    NamedMaker make;
  };
  struct Form {
    std::size_t description;
    std::function<std::optional<Strategy>(std::string_view, const Payoffs&)> make;
  };
  struct Group {  // one of the three
    std::string members;
    FamilyMaker family;
    SelectionMaker selection;
  };
  struct Prefix {
    std::string prefix;
    std::size_t description;
    GroupMaker make;
  };

  Pool item(std::string_view item, const Payoffs& payoffs) const;
  Pool unlabelled(std::string_view item, const Payoffs& payoffs) const;
  Pool members_of(const Group& group, std::optional<std::string_view> arguments, const Payoffs& payoffs) const;
  void refuse_repeated_groups(const std::vector<std::string>& parts) const;
  Pool items(std::string_view spec, const Payoffs& payoffs) const;
  Pool pool(std::string_view spec, const Payoffs& payoffs) const;
  const Named* find_named(std::string_view name) const;
  [[noreturn]] void unknown(std::string_view name) const;

  std::vector<Description> strategies_;
  std::vector<Description> groups_;
  std::map<std::string, Named, std::less<>> named_;         // by key
  std::map<std::string, Group, std::less<>> group_makers_;  // by key
  std::vector<Form> forms_;
  std::vector<Prefix> prefixes_;
};

/// The roster with each strategy that several of its rosters and families hold (Strategy::of_family) once, at its first
/// place. Throws UsageError when two others have the same_name.
std::vector<Strategy> merged(std::vector<Strategy> roster);

/// Throws UsageError when two strategies of a roster have the same_name.
void refuse_duplicates(const std::vector<Strategy>& roster);

}  // namespace folk
