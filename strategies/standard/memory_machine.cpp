#include <fmt/format.h>
#include <folk/games/error.h>
#include <folk/strategies/names.h>
#include <folk/strategies/standard/memory_machine.h>

#include <algorithm>
#include <utility>

namespace folk {
namespace {

// A state: rounds played up to the openings' number, the own last moves, their last moves, 16 bits each.
constexpr unsigned field = 16;
constexpr State field_mask = (State{1} << field) - 1;

State shift_in(State history, unsigned length, Move move) {
  return ((history << 1U) | bit(move)) & ((State{1} << length) - 1);
}

}  // namespace

MemoryMachine::MemoryMachine(unsigned own_memory, unsigned their_memory, std::vector<bool> openings,
                             std::vector<bool> table)
    : own_memory_(own_memory),
      their_memory_(their_memory),
      openings_(std::move(openings)),
      table_(std::move(table)) {
  const unsigned both = own_memory + their_memory;
  if (both == 0 || both > longest_memory)
    throw UsageError(
        fmt::format("memory({},{}): X + Y must be from 1 to {}", own_memory, their_memory, longest_memory));
  if (openings_.size() != std::max(own_memory, their_memory) || table_.size() != std::size_t{1} << both)
    throw UsageError(fmt::format("mem{}{} needs {} opening moves and a table of {}", own_memory, their_memory,
                                 std::max(own_memory, their_memory), std::size_t{1} << both));
}

std::optional<MemoryMachine> MemoryMachine::parse(std::string_view name) {
  const std::string key = name_key(name);
  const auto digit = [&](std::size_t i) { return key[i] >= '0' && key[i] <= '9'; };
  if (key.size() < 6 || key.compare(0, 3, "mem") != 0 || !digit(3) || !digit(4)) return std::nullopt;
  std::vector<bool> moves;
  for (const char c : key.substr(5)) {
    if (c != 'c' && c != 'd') return std::nullopt;
    moves.push_back(c == 'd');
  }
  const auto own = static_cast<unsigned>(key[3] - '0');
  const auto theirs = static_cast<unsigned>(key[4] - '0');
  if (own + theirs == 0 || own + theirs > longest_memory)
    throw UsageError(fmt::format("'{}': X + Y of mem<X><Y> must be from 1 to {}", excerpt(name), longest_memory));
  const std::size_t openings = std::max(own, theirs);
  const std::size_t table = std::size_t{1} << (own + theirs);
  if (moves.size() != openings + table)
    throw UsageError(fmt::format("'{}': mem{}{} takes {} opening moves and a table of {}, not {} moves in all",
                                 excerpt(name), own, theirs, openings, table, moves.size()));
  const auto split = moves.begin() + static_cast<std::ptrdiff_t>(openings);
  return MemoryMachine(own, theirs, {moves.begin(), split}, {split, moves.end()});
}

std::string MemoryMachine::name() const {
  std::string text = fmt::format("mem{}{}_", own_memory_, their_memory_);
  for (const bool defects : openings_) text += defects ? 'd' : 'c';
  for (const bool defects : table_) text += defects ? 'D' : 'C';
  return text;
}

double MemoryMachine::cooperation(State state) const {
  const State played = state >> (2 * field);
  if (played < openings_.size()) return openings_[played] ? 0 : 1;
  const State own = (state >> field) & field_mask;
  return table_[(own << their_memory_) | (state & field_mask)] ? 0 : 1;
}

State MemoryMachine::next(State state, Move own, Move theirs) const {
  const State played = std::min<State>((state >> (2 * field)) + 1, openings_.size());
  const State own_history = shift_in((state >> field) & field_mask, own_memory_, own);
  const State their_history = shift_in(state & field_mask, their_memory_, theirs);
  return (played << (2 * field)) | (own_history << field) | their_history;
}

}  // namespace folk
