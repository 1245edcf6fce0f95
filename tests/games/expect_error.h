#pragma once
// Tests of refusals: the type of what is thrown and what its message says.

#include <folk/games/error.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>
#include <string_view>
#include <typeinfo>

namespace folk::test {

/// Expects `act` to throw exactly `Thrown`, with a message of one line that holds `part`.
template <class Thrown>
void expect_error(const std::function<void()>& act, std::string_view part) {
  try {
    act();
    ADD_FAILURE() << "nothing was thrown; expected a message with: " << part;
  } catch (const Error& error) {
    const std::string message = error.what();
    EXPECT_EQ(typeid(error), typeid(Thrown)) << message;
    EXPECT_NE(message.find(part), std::string::npos) << "'" << part << "' is not in: " << message;
    EXPECT_TRUE(std::none_of(message.begin(), message.end(), [](unsigned char c) { return c < 0x20; })) << message;
  }
}

}  // namespace folk::test
