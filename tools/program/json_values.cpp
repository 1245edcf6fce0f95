#include <folk/tools/program/json_values.h>

#include <cmath>

namespace folk::tools {

Json json_number(double value) { return std::isfinite(value) ? Json(value) : Json("infinity"); }

Json belief_json(const std::optional<BeliefConsistency>& belief) {
  if (!belief) return nullptr;
  Json bins = Json::array();
  for (const auto& bin : belief->bins)
    bins.push_back({{"count", bin.count},
                    {"mean_belief", json_optional(bin.mean_belief())},
                    {"frequency", json_optional(bin.frequency())}});
  return {{"sup_tv", belief->largest_distance},
          {"mean_tv", json_optional(belief->mean_distance())},
          {"accuracy", json_optional(belief->accuracy())},
          {"log_loss", belief->log_loss() ? json_number(*belief->log_loss()) : Json(nullptr)},
          {"brier", json_optional(belief->brier())},
          {"settled_from", json_optional(belief->settled_from())},
          {"wrong_rounds", belief->wrong_rounds},
          {"calibration", bins}};
}

}  // namespace folk::tools
