#include <folk/tools/description/spec_candidates.h>

#include <folk/games/error.h>

#include <algorithm>
#include <cctype>
#include <string>

namespace folk::tools {
namespace {

/// "SPEC;N;seed=S" of "sample(SPEC;N;seed=S)" taken apart.
std::vector<std::string> parameters_of(const Registry& registry, std::string_view head) {
  const std::string begin = std::string(head) + "(";
  for (const auto* described : {&registry.strategies(), &registry.groups()})
    for (const auto& [name, aliases, behaviour, reference, elsewhere] : *described) {
      if (!name.starts_with(begin)) continue;
      std::vector<std::string> parameters(1);
      for (const char c : name.substr(begin.size(), name.size() - begin.size() - 1))
        if (c == ';')
          parameters.emplace_back();
        else
          parameters.back() += c;
      return parameters;
    }
  return {};
}

/// "hard=" or "3*" before what an item names, label and weight.
std::string_view without_label(std::string_view item) {
  const auto first = item.find_first_of("=*([@\":");
  return first != std::string_view::npos && (item[first] == '=' || item[first] == '*') ? item.substr(first + 1) : item;
}

/// What is being typed at the end of a SPEC.
struct Place {
  bool in_brackets = false;
  std::size_t begin = 0;  ///< of the item
  std::vector<std::string> open{
      "SPEC"};  ///< what may stand here: a SPEC at first, in brackets the parameters that are left
};

/// Follows brackets and separators to the end; nothing may follow a closed bracket but a separator.
Place place_of(const Registry& registry, std::string_view spec) {
  std::vector<std::vector<std::string>> levels{{"SPEC"}};
  bool quoted = false;
  bool closed = false;
  Place place;
  for (std::size_t i = 0; i < spec.size(); ++i) {
    const char c = spec[i];
    if (c == '"') quoted = !quoted;
    if (quoted) continue;
    switch (c) {
      case '(':
        levels.push_back(parameters_of(registry, without_label(spec.substr(place.begin, i - place.begin))));
        place.begin = i + 1;
        break;
      case ')':
        if (levels.size() > 1) levels.pop_back();
        closed = true;
        break;
      case ';':
        if (levels.size() > 1 && !levels.back().empty()) levels.back().erase(levels.back().begin());
        [[fallthrough]];
      case ',':
        place.begin = i + 1;
        closed = false;
        break;
      default: break;
    }
  }
  place.in_brackets = levels.size() > 1;
  place.open = closed || quoted ? std::vector<std::string>{} : levels.back();
  return place;
}

/// The machines of "@FILE#", as the file calls them.
std::vector<Candidate> machine_candidates(const Registry& registry, std::string_view prefix, std::string_view item) {
  const auto mark = item.find('#');
  std::vector<Candidate> machines;
  if (item.substr(0, mark) == "@-") return machines;  // what is on the standard input is not for us
  try {
    for (const auto& strategy : registry.roster(item.substr(0, mark)))
      machines.push_back({strategy.name.substr(strategy.name.find('#') + 1)});
  } catch (const Error&) {  // no such file, or no machines in it
  }
  std::vector<Candidate> candidates;
  add_beginning_with(candidates, std::string(prefix) + std::string(item.substr(0, mark + 1)), item.substr(mark + 1),
                     machines);
  return candidates;
}

/// Every name, with a hint of what it takes; the other names of a strategy once they are begun.
std::vector<Candidate> named(const Registry& registry, std::string_view prefix, std::string_view item) {
  std::vector<Candidate> all;
  std::vector<Candidate> others;
  for (const auto* described : {&registry.strategies(), &registry.groups()})
    for (const auto& [name, aliases, behaviour, reference, elsewhere] : *described) {
      const std::string literal(literal_part(name));
      const bool complete = literal == name;
      if (literal.empty() || name.find('<') != std::string::npos) continue;
      all.push_back({literal, complete ? behaviour : name + ": " + behaviour, complete});
      for (const auto& alias : aliases) others.push_back({alias, name + ": " + behaviour});
    }
  std::vector<Candidate> candidates;
  add_beginning_with(candidates, prefix, item, all);
  if (!item.empty()) add_beginning_with(candidates, prefix, item, others);
  return candidates;
}

std::vector<Candidate> item_candidates(const Registry& registry, std::string_view prefix, std::string_view item) {
  if (item.starts_with('@') && item.find('#') != std::string_view::npos)
    return machine_candidates(registry, prefix, item);
  for (const std::string_view before_path : {"@", "sct:"})
    if (item.starts_with(before_path))
      return path_candidates(std::string(prefix) + std::string(before_path), item.substr(before_path.size()));
  return named(registry, prefix, item);
}

}  // namespace

std::string_view literal_part(std::string_view name) {
  const auto upper = std::find_if(name.begin(), name.end(), [](unsigned char c) { return std::isupper(c) != 0; });
  const auto mark = std::min(name.find_first_of("<\"("), static_cast<std::size_t>(upper - name.begin()));
  return name.substr(0, mark < name.size() && name[mark] == '(' ? mark + 1 : mark);
}

std::vector<Candidate> spec_candidates(const Registry& registry, std::string_view spec) {
  const Place place = place_of(registry, spec);
  if (place.open.empty()) return {};
  const std::string_view typed = spec.substr(place.begin);
  const std::string_view item = place.open.front() == "SPEC" ? without_label(typed) : typed;
  const std::string_view prefix = spec.substr(0, spec.size() - item.size());
  if (const bool spec_here = place.open.front() == "SPEC"; spec_here || place.open.front() == "FILE") {
    auto candidates = spec_here ? item_candidates(registry, prefix, item) : path_candidates(prefix, item);
    for (auto& candidate : candidates) candidate.complete &= !place.in_brackets;  // they are still to be closed
    return candidates;
  }
  std::vector<Candidate> options;  // "depth=H": whatever is left may come first
  for (const auto& parameter : place.open)
    if (const auto sign = parameter.find('='); sign != std::string::npos)
      options.push_back({parameter.substr(0, sign + 1), parameter, false});
  std::vector<Candidate> candidates;
  add_beginning_with(candidates, prefix, item, options);
  return candidates;
}

}  // namespace folk::tools
