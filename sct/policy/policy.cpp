#include <folk/games/error.h>
#include <folk/sct/policy/policy.h>

#include <fmt/format.h>

namespace folk::sct {

std::string_view to_string(LossMode mode) {
  switch (mode) {
    case LossMode::teacher: return "teacher";
    case LossMode::selfconf: return "selfconf";
    case LossMode::composite: return "composite";
    case LossMode::action_only: return "action_only";
  }
  return "?";
}

LossMode parse_loss_mode(std::string_view text) {
  for (const auto mode : {LossMode::teacher, LossMode::selfconf, LossMode::composite, LossMode::action_only})
    if (text == to_string(mode)) return mode;
  throw UsageError(
      fmt::format("'{}' is no loss mode: expected teacher, selfconf, composite or action_only", excerpt(text)));
}

}  // namespace folk::sct
