#pragma once
// SIGINT and SIGTERM as a question that long work asks itself.

#include <string>

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

/// The end of work that they asked for: throws EnvironmentError, with "generation 7" or the like for how far it got.
/// `kept`: there is a journal.
[[noreturn]] void end_interrupted(bool kept, const std::string& how_far);

}  // namespace folk::tools
