#include <folk/analysis/crew/failure.h>
#include <folk/games/error.h>
#include <folk/games/progress.h>

#include <new>

namespace folk {
namespace {

enum Kind : char { cancelled = 'c', usage = 'u', input_file = 'i', undecided = 'd', memory = 'm', environment = 'e' };

}  // namespace

std::string failure_bytes(const std::exception_ptr& failure, std::string_view prefix) {
  const auto bytes = [&](Kind kind, std::string_view message) {
    return std::string(1, kind).append(prefix).append(message);
  };
  try {
    std::rethrow_exception(failure);
  } catch (const Cancelled& error) {
    return bytes(cancelled, error.what());
  } catch (const UsageError& error) {
    return bytes(usage, error.what());
  } catch (const InputFileError& error) {
    return bytes(input_file, error.what());
  } catch (const UndecidedError& error) {
    return bytes(undecided, error.what());
  } catch (const std::bad_alloc&) {
    return bytes(memory, "not enough memory for this");
  } catch (const std::exception& error) {
    return bytes(environment, error.what());
  } catch (...) {
    return bytes(environment, "something unknown was thrown");
  }
}

std::exception_ptr failure_from(std::string_view bytes) {
  const std::string message(bytes.substr(bytes.empty() ? 0 : 1));
  switch (bytes.empty() ? environment : static_cast<Kind>(bytes.front())) {
    case cancelled: return std::make_exception_ptr(Cancelled(message));
    case usage: return std::make_exception_ptr(UsageError(message));
    case input_file: return std::make_exception_ptr(InputFileError(message));
    case undecided: return std::make_exception_ptr(UndecidedError(message));
    case memory:
    case environment: break;
  }
  return std::make_exception_ptr(EnvironmentError(message));
}

}  // namespace folk
