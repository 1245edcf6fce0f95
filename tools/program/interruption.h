#pragma once
// SIGINT and SIGTERM as a question that long work asks itself.

namespace folk::tools {

/// While one lives, the first of the two signals only sets a flag; a second one ends the process as ever.
class Interruption {
public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  static bool requested();
};

}  // namespace folk::tools
