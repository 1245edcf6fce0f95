#pragma once
// Values that reports in JSON share.

#include <folk/analysis/beliefs/belief_consistency.h>

#include <nlohmann/json.hpp>
#include <optional>

namespace folk::tools {

/// Keys stay in the order in which they are written.
using Json = nlohmann::ordered_json;

/// null where there is nothing.
template <class Value>
Json json_optional(const std::optional<Value>& value) {
  return value ? Json(*value) : Json(nullptr);
}

/// "infinity" for what JSON has no number for.
Json json_number(double value);

/// How beliefs scored, null without any.
Json belief_json(const std::optional<BeliefConsistency>& belief);

}  // namespace folk::tools
