#include <folk/tools/choices/standard_names.h>

#include <folk/tools/choices/policy_names.h>
#include <folk/tools/program/standard_input.h>

#include <fmt/format.h>
#include <folk/analysis/replies/bayes_player.h>
#include <folk/games/error.h>

#include <algorithm>
#include <utility>

namespace folk::tools {

Registry standard_names(const sct::PlayOptions& options) {
  Registry registry = Registry::standard([](const std::string& file) { return read_file_or_input(file, "@-"); });
  add_policies(registry, options);
  add_bayes(registry);
  if (MoreNames::latest != nullptr) MoreNames::latest->add_(registry);
  return registry;
}

thread_local const MoreNames* MoreNames::latest = nullptr;

MoreNames::MoreNames(std::function<void(Registry&)> add)
    : add_(std::move(add)),
      before_(std::exchange(latest, this)) {}

MoreNames::~MoreNames() { latest = before_; }

std::vector<Strategy> with_guests(const Registry& registry, std::vector<Strategy> roster, const std::string& spec,
                                  const std::string& guests_spec, const Payoffs& payoffs) {
  for (auto& guest : registry.roster(guests_spec, payoffs)) roster.push_back(std::move(guest));
  const std::size_t all = roster.size();
  roster = merged(std::move(roster));
  if (roster.size() == all) return roster;
  // What overlaps is merged, but a family that was named in both was named twice.
  const auto named = split_list(spec);
  for (const auto& item : split_list(guests_spec))
    if (std::any_of(named.begin(), named.end(), [&](const auto& other) { return same_name(item, other); }))
      throw UsageError(fmt::format("'{}' is given twice: name it once", excerpt(item)));
  return roster;
}

}  // namespace folk::tools
