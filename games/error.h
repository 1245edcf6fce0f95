#pragma once
// What Folk throws. Library code never prints or exits; a program turns these into one line on stderr and an exit code.

#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>

namespace folk {

/// Base of everything Folk throws on purpose. The message says what, where and what to do, on one line.
class Error : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/// A name, a number or an option that cannot be accepted (exit code 2).
class UsageError : public Error {
public:
  using Error::Error;
};

/// A file that cannot be read or makes no sense (exit code 3).
class InputFileError : public Error {
public:
  using Error::Error;
};

/// The world outside failed: a program that died, an output that cannot be written (exit code 4).
class EnvironmentError : public Error {
public:
  using Error::Error;
};

/// A question that the way in which it is computed cannot decide (exit code 4).
class UndecidedError : public Error {
public:
  using Error::Error;
};

/// Input as a message shows it: at most `most` bytes, "..." where it was cut, '?' for each character that is undrawn
/// (utf8.h) and each byte that is none, so that the message stays on one line, and text, whatever was read.
std::string excerpt(std::string_view text, std::size_t most = 40);

/// Throws InputFileError "file: why", where `why` also says what to do.
[[noreturn]] void refuse_file(std::string_view file, std::string_view why);

}  // namespace folk
