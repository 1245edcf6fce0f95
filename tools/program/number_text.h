#pragma once
// Numbers and texts as programs write them into tables and JSON.

#include <folk/games/payoffs.h>

#include <string>

namespace folk::tools {

/// Whole numbers without an exponent, others as the shortest decimal that reads back.
std::string number_text(long double value);

/// A total for the eye.
std::string total_text(long double total);

/// A JSON string.
std::string json_string(const std::string& text);

/// A JSON object: T, R, P, S.
std::string payoffs_json(const Payoffs& payoffs);

}  // namespace folk::tools
