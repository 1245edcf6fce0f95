#include <fmt/format.h>
#include <folk/games/error.h>
#include <folk/strategies/nearest_names.h>
#include <folk/strategies/registry.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <stdexcept>
#include <utility>

namespace folk {
namespace {

/// "head(arguments)" split at the first parenthesis; no arguments when there is none.
struct Call {
  std::string_view head;
  std::optional<std::string_view> arguments;
};

Call split_call(std::string_view name) {
  const auto open = name.find('(');
  if (open == std::string_view::npos) return {name, std::nullopt};
  if (name.back() != ')')
    throw UsageError(
        fmt::format("'{}': the parenthesis after '{}' is not closed", excerpt(name), excerpt(name.substr(0, open))));
  return {name.substr(0, open), name.substr(open + 1, name.size() - open - 2)};
}

/// A strategy with parameters may have the name of one without: sct-plan(FILE) and sct-plan.
std::string named_key(std::string_view head, bool takes_arguments) {
  return name_key(head) + (takes_arguments ? "()" : "");
}

[[noreturn]] void refuse_duplicate(const std::string& name) {
  throw UsageError(
      fmt::format("strategy '{}' is given twice: name it once (other names of it count too)", excerpt(name, 100)));
}

}  // namespace

std::vector<Strategy> merged(std::vector<Strategy> roster) {
  std::map<std::string, bool> seen;  // by identity: whether it came with a roster or family
  std::erase_if(roster, [&](const Strategy& strategy) {
    const auto [first, is_new] = seen.try_emplace(name_identity(strategy.name), strategy.of_family);
    if (!is_new && !(first->second && strategy.of_family)) refuse_duplicate(strategy.name);
    return !is_new;
  });
  return roster;
}

void refuse_duplicates(const std::vector<Strategy>& roster) {
  std::set<std::string> seen;
  for (const auto& strategy : roster)
    if (!seen.insert(name_identity(strategy.name)).second) refuse_duplicate(strategy.name);
}

void Registry::add(Description description, NamedMaker make) {
  const Call call = split_call(description.name);
  const Named named{strategies_.size(), call.arguments.has_value(), std::move(make)};
  std::set<std::string> keys{named_key(call.head, named.takes_arguments)};
  for (const auto& alias : description.aliases) keys.insert(named_key(alias, named.takes_arguments));
  for (const auto& key : keys)
    if (!named_.try_emplace(key, named).second) throw std::logic_error("two strategies are called " + key);
  strategies_.push_back(std::move(description));
}

void Registry::add_form(Description description,
                        std::function<std::optional<Strategy>(std::string_view, const Payoffs&)> make) {
  forms_.push_back({strategies_.size(), std::move(make)});
  strategies_.push_back(std::move(description));
}

void Registry::add_roster(Description description, std::string members) {
  group_makers_[name_key(description.name)] = {std::move(members), nullptr, nullptr};
  groups_.push_back(std::move(description));
}

void Registry::add_family(Description description, FamilyMaker make) {
  group_makers_[name_key(split_call(description.name).head)] = {{}, std::move(make), nullptr};
  groups_.push_back(std::move(description));
}

void Registry::add_selection(Description description, SelectionMaker make) {
  group_makers_[name_key(split_call(description.name).head)] = {{}, nullptr, std::move(make)};
  groups_.push_back(std::move(description));
}

void Registry::add_prefix(Description description, std::string prefix, GroupMaker make) {
  prefixes_.push_back({std::move(prefix), strategies_.size(), std::move(make)});
  strategies_.push_back(std::move(description));
}

const Registry::Named* Registry::find_named(std::string_view name) const {
  const Call call = split_call(name);
  const bool arguments = call.arguments.has_value();
  for (const bool takes_arguments : {arguments, !arguments})
    if (const auto found = named_.find(named_key(call.head, takes_arguments)); found != named_.end())
      return &found->second;
  return nullptr;
}

Pool Registry::item(std::string_view item, const Payoffs& payoffs) const {
  const auto [label, spec] = split_label(item);
  auto found = unlabelled(spec, payoffs);
  if (!label) return found;
  auto strategies = list_of(std::move(found));
  if (strategies.size() != 1)
    throw UsageError(fmt::format("'{}': a label names one strategy, not {} (of a file: {}=@FILE#NAME)", excerpt(item),
                                 strategies.size(), *label));
  Strategy& strategy = strategies.front();
  if (strategy.caveat.starts_with(strategy.name)) strategy.caveat.replace(0, strategy.name.size(), *label);
  strategy.name = *label;
  strategy.of_family = false;
  return {std::move(strategies), {}};
}

Pool Registry::members_of(const Group& group, std::optional<std::string_view> arguments, const Payoffs& payoffs) const {
  auto found = group.family ? pool_of(group.family(*arguments))
               : group.selection
                   ? group.selection(*arguments, [&](std::string_view spec) { return pool(spec, payoffs); })
                   : items(group.members, payoffs);
  for (auto& strategy : found.listed) strategy.of_family = true;
  return found;
}

Pool Registry::unlabelled(std::string_view item, const Payoffs& payoffs) const {
  for (const auto& [prefix, description, make] : prefixes_)
    if (item.substr(0, prefix.size()) == prefix) return {make(item.substr(prefix.size()), payoffs), {}};
  const Call call = split_call(item);
  const std::string key = name_key(call.head);
  if (const auto group = group_makers_.find(key); group != group_makers_.end()) {
    const bool is_roster = !group->second.family && !group->second.selection;
    if (call.arguments.has_value() == is_roster)
      throw UsageError(fmt::format("'{}': {}", excerpt(item),
                                   is_roster ? "takes no parameters" : "needs its parameters in parentheses"));
    return members_of(group->second, call.arguments, payoffs);
  }
  if (const Named* named = find_named(item)) {
    const auto& description = strategies_[named->description];
    if (call.arguments.has_value() != named->takes_arguments)
      throw UsageError(fmt::format(
          "'{}': {}", excerpt(item),
          call.arguments ? "takes no parameters" : fmt::format("needs its parameters, as in {}", description.name)));
    return {{named->make(description.name, call.arguments.value_or(""), payoffs)}, {}};
  }
  for (const auto& form : forms_)
    if (auto strategy = form.make(item, payoffs)) return {{*std::move(strategy)}, {}};
  unknown(item);
}

Strategy Registry::make(std::string_view name, const Payoffs& payoffs) const {
  const auto parts = split_list(name);
  if (parts.size() != 1) throw UsageError(fmt::format("'{}': expected the name of one strategy", excerpt(name)));
  auto found = list_of(item(parts.front(), payoffs));
  if (found.size() != 1)
    throw UsageError(fmt::format("'{}' stands for {} strategies: expected one (of a file: @FILE#NAME)", excerpt(name),
                                 found.size()));
  return std::move(found.front());
}

Pool Registry::items(std::string_view spec, const Payoffs& payoffs) const {
  Pool found;
  for (const auto& part : split_list(spec)) {
    auto [listed, unlisted] = item(part, payoffs);
    std::move(listed.begin(), listed.end(), std::back_inserter(found.listed));
    std::move(unlisted.begin(), unlisted.end(), std::back_inserter(found.unlisted));
  }
  return found;
}

Pool Registry::pool(std::string_view spec, const Payoffs& payoffs) const {
  refuse_repeated_groups(split_list(spec));
  Pool found = items(spec, payoffs);
  found.listed = merged(std::move(found.listed));
  std::set<std::string> seen;
  for (const auto& family : found.unlisted)
    if (!seen.insert(family.name).second)
      throw UsageError(fmt::format("'{}' is given twice: name it once", family.name));
  return found;
}

std::vector<Strategy> Registry::roster(std::string_view spec, const Payoffs& payoffs) const {
  auto roster = list_of(pool(spec, payoffs));
  if (roster.empty())
    throw UsageError("the roster is empty: name strategies, as in 'classics' or 'pavlov,tit_for_tat'");
  return roster;
}

void Registry::refuse_repeated_groups(const std::vector<std::string>& parts) const {
  std::set<std::string> seen;
  for (const auto& part : parts)
    if (group_makers_.contains(name_key(part.substr(0, part.find('(')))) && !seen.insert(name_key(part)).second)
      throw UsageError(fmt::format("'{}' is given twice: name it once", excerpt(part)));
}

const Description& Registry::describe(std::string_view item) const {
  const std::string_view name = split_label(item).spec;
  for (const auto& prefix : prefixes_)
    if (name.substr(0, prefix.prefix.size()) == prefix.prefix) return strategies_[prefix.description];
  if (const Named* named = find_named(name)) return strategies_[named->description];
  for (const auto& group : groups_)
    if (name_key(split_call(group.name).head) == name_key(split_call(name).head)) return group;
  for (const auto& form : forms_)
    if (form.make(name, {})) return strategies_[form.description];
  unknown(name);
}

void Registry::unknown(std::string_view name) const {
  std::vector<NameCandidate> candidates;
  for (const auto& [key, named] : named_)
    candidates.push_back({key.substr(0, key.find('(')), strategies_[named.description].name});
  for (const auto& group : groups_) candidates.push_back({name_key(split_call(group.name).head), group.name});
  const auto names = nearest_names(name, candidates);
  throw UsageError(fmt::format("unknown strategy '{}'{}; 'ipd-strategies list' shows all", excerpt(name),
                               names.empty() ? "" : fmt::format(": did you mean {}?", fmt::join(names, ", "))));
}

}  // namespace folk
