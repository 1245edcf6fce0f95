#include <folk/games/error.h>
#include <folk/strategies/standard/periodic_machine.h>

namespace folk {

PeriodicMachine::PeriodicMachine(std::string_view word) {
  constexpr std::size_t longest = 10'000;
  for (const char c : word) {
    const bool cooperates = c == 'c' || c == 'C';
    if (!cooperates && c != 'd' && c != 'D')
      throw UsageError("per_" + excerpt(word) + ": a word is made of c and d, as in per_ccd");
    word_.push_back(!cooperates);
  }
  if (word_.empty() || word_.size() > longest)
    throw UsageError("per_<word> needs a word of 1 to " + std::to_string(longest) + " moves, as in per_ccd");
}

std::string PeriodicMachine::name() const {
  std::string text = "per_";
  for (const bool defects : word_) text += defects ? 'd' : 'c';
  return text;
}

}  // namespace folk
