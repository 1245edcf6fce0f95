#include <folk/tools/ipd_evolve/played_scores.h>

#include <nlohmann/json.hpp>

namespace folk::tools {

std::string json_text(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace folk::tools
