#include <folk/tools/program/number_text.h>

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace folk::tools {

std::string number_text(long double value) {
  if (value == std::floor(value) && std::abs(value) < 0x1p63L) return fmt::format("{}", static_cast<long long>(value));
  return fmt::format("{}", static_cast<double>(value));
}

std::string total_text(long double total) {
  return total == std::floor(total) ? number_text(total) : fmt::format("{:.4f}", static_cast<double>(total));
}

std::string json_string(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string payoffs_json(const Payoffs& payoffs) {
  const auto number = [](const Rational& payoff) { return fmt::format("{}", to_double(payoff)); };
  return fmt::format("{{\"T\": {}, \"R\": {}, \"P\": {}, \"S\": {}}}", number(payoffs.temptation),
                     number(payoffs.reward), number(payoffs.punishment), number(payoffs.sucker));
}

}  // namespace folk::tools
