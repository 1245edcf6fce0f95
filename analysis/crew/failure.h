#pragma once
// What ends a rank's work: what another rank threw, as bytes that are thrown again, and its dismissal.

#include <folk/games/progress.h>

#include <exception>
#include <string>
#include <string_view>

namespace folk {

/// Thrown on ranks other than 0 when rank 0's program has ended while they wait for work. Nothing is wrong here.
class Dismissed : public Cancelled {
public:
  Dismissed()
      : Cancelled("rank 0 has ended") {}
};

/// Its kind among the exceptions of games/error.h, std::bad_alloc and all others, and its message. `prefix` is put
/// before the message.
std::string failure_bytes(const std::exception_ptr& failure, std::string_view prefix = {});

/// The same kind with the same message; EnvironmentError for other kinds.
std::exception_ptr failure_from(std::string_view bytes);

}  // namespace folk
