#include <folk/tools/choices/play_options.h>
#include <folk/tools/choices/roster_option.h>
#include <folk/tools/choices/standard_names.h>

#include <fmt/format.h>
#include <folk/games/error.h>
#include <folk/strategies/registry.h>

#include <string>
#include <utility>

namespace folk::tools {
namespace {

/// Takes out what --exclude says: names that entrants go by, labels among them, and what else a SPEC may say.
void leave_out(std::vector<Strategy>& entrants, const std::string& spec, const Registry& registry,
               const Payoffs& payoffs) {
  std::string others;
  for (const auto& item : split_list(spec)) {
    const auto called_so = [&](const Strategy& strategy) { return same_name(strategy.name, item); };
    if (std::erase_if(entrants, called_so) == 0) others += (others.empty() ? "" : ",") + item;
  }
  if (others.empty() && !split_list(spec).empty()) return;
  for (const auto& left_out : registry.roster(others, payoffs)) {
    const auto same = [&](const Strategy& strategy) { return same_name(strategy.name, left_out.name); };
    if (std::erase_if(entrants, same) == 0)
      throw UsageError(fmt::format("--exclude {}: it is not in the roster", left_out.name));
  }
}

}  // namespace

Field chosen_field(const po::variables_map& values, const Payoffs& payoffs) {
  const Registry registry = standard_names(chosen_play_options(values));
  Field field{registry.roster(text_option(values, "strategies"), payoffs), 0};
  if (values.count("exclude") != 0) leave_out(field.entrants, text_option(values, "exclude"), registry, payoffs);
  if (field.entrants.empty()) throw UsageError("the roster is empty: --exclude leaves nobody");
  field.core = field.entrants.size();
  if (values.count("include") != 0)
    field.entrants = with_guests(registry, std::move(field.entrants), text_option(values, "strategies"),
                                 text_option(values, "include"), payoffs);
  return field;
}

}  // namespace folk::tools
