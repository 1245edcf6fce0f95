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

std::string payoff_text(double value) {
  if (value == std::floor(value) && std::abs(value) < 1e15) return fmt::format("{:.0f}", value);
  return std::abs(value) < 1e-3 ? fmt::format("{:.3g}", value) : fmt::format("{:.4f}", value);
}

std::string share_text(const std::optional<double>& share) {
  return share ? fmt::format("{:.2f} %", 100 * *share) : "-";
}

std::string measure_text(const std::optional<double>& value) {
  if (!value) return "-";
  return std::isfinite(*value) ? fmt::format("{:.4g}", *value) : "infinite";
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
