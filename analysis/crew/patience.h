#pragma once
// How long a rank sleeps before it looks for messages again.

#include <algorithm>
#include <chrono>

namespace folk {

/// Twice as long each time that nothing has come, from 20 microseconds to a millisecond.
class Patience {
public:
  std::chrono::microseconds next() { return sleep_ = std::min(2 * sleep_, longest); }
  void renew() { sleep_ = shortest; }

private:
  static constexpr std::chrono::microseconds shortest{10};
  static constexpr std::chrono::microseconds longest{1000};

  std::chrono::microseconds sleep_ = shortest;
};

}  // namespace folk
