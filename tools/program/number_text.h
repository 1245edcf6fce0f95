#pragma once
// Numbers and texts as programs write them into tables and JSON.

#include <folk/games/payoffs.h>

#include <optional>
#include <string>

namespace folk::tools {

/// Whole numbers without an exponent, others as the shortest decimal that reads back.
std::string number_text(long double value);

/// A total for the eye.
std::string total_text(long double total);

/// A payoff: "3", "2.6667".
std::string payoff_text(double value);

/// A share of 1: "97.59 %"; "-" where there is none.
std::string share_text(const std::optional<double>& share);

/// A distance or a loss: "0.1234", "infinite"; "-" where there is none.
std::string measure_text(const std::optional<double>& value);

/// A JSON string.
std::string json_string(const std::string& text);

/// A JSON object: T, R, P, S.
std::string payoffs_json(const Payoffs& payoffs);

}  // namespace folk::tools
