#include <fmt/format.h>
#include <folk/games/error.h>
#include <folk/games/rational.h>
#include <folk/strategies/names.h>
#include <folk/strategies/standard/memory_class.h>

#include <algorithm>

namespace folk {

MemoryClass::MemoryClass(unsigned own_memory, unsigned their_memory)
    : own_memory_(own_memory),
      their_memory_(their_memory),
      openings_(std::max(own_memory, their_memory)) {
  if (own_memory > 9 || their_memory > 9 || own_memory + their_memory == 0 ||
      own_memory + their_memory > MemoryMachine::longest_memory)
    throw UsageError(fmt::format("memory({},{}): X + Y must be from 1 to {}", own_memory, their_memory,
                                 MemoryMachine::longest_memory));
}

MemoryClass MemoryClass::of_arguments(std::string_view arguments) {
  const auto comma = arguments.find(',');
  if (comma == std::string_view::npos || arguments.find(',', comma + 1) != std::string_view::npos)
    throw UsageError(fmt::format("memory({}): expected two numbers, memory(X,Y)", excerpt(arguments)));
  const auto length = [](std::string_view text, std::string_view what) {
    while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
    while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
    return static_cast<unsigned>(parse_whole_number(text, what, 0, 9));
  };
  return {length(arguments.substr(0, comma), "memory(X,Y) X"), length(arguments.substr(comma + 1), "memory(X,Y) Y")};
}

std::optional<MemoryClass> MemoryClass::parse(std::string_view text) {
  const auto open = text.find('(');
  if (open == std::string_view::npos || name_key(text.substr(0, open)) != "memory") return std::nullopt;
  const auto close = text.find_last_not_of(' ');
  if (text[close] != ')') return std::nullopt;
  return of_arguments(text.substr(open + 1, close - open - 1));
}

std::string MemoryClass::name() const { return fmt::format("memory({},{})", own_memory_, their_memory_); }

Integer MemoryClass::size() const { return pow(Integer(2), genes()); }

std::string MemoryClass::size_text() const { return genes() <= 30 ? size().str() : fmt::format("2^{}", genes()); }

MemoryMachine MemoryClass::member(const std::vector<bool>& genes) const {
  const auto split = genes.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(openings(), genes.size()));
  return MemoryMachine(own_memory_, their_memory_, {genes.begin(), split}, {split, genes.end()});
}

MemoryMachine MemoryClass::member(Integer index) const {
  std::vector<bool> moves(genes());
  for (std::size_t i = moves.size(); i-- > 0; index /= 2) moves[i] = !(index % 2).is_zero();
  return member(moves);
}

}  // namespace folk
