#include <folk/analysis/classes/behaviours.h>
#include <folk/analysis/classes/class_tournament.h>
#include <folk/analysis/play/parallel.h>
#include <folk/games/error.h>
#include <folk/strategies/automaton.h>

#include <fmt/format.h>

#include <string>
#include <unordered_map>

namespace folk {
namespace {

/// A deterministic automaton letter by letter: equal texts are equal automata.
std::string letters(const Automaton& automaton) {
  std::string text;
  const auto number = [&](std::uint32_t value) {
    text += static_cast<char>(value & 0xFFU);
    text += static_cast<char>(value >> 8U);
  };
  for (const auto& node : automaton.nodes()) {
    const std::size_t own = node.cooperation > 0.5 ? 0 : 2;
    number(static_cast<std::uint32_t>(own));
    number(node.next[own]);
    number(node.next[own + 1]);
  }
  return text;
}

}  // namespace

Behaviours behaviours_of(const MemoryClass& members, unsigned threads, const Progress& progress) {
  if (members.entries() > most_ranked_entries)
    throw UsageError(fmt::format("{} has {} members: behaviours are told apart up to X + Y = 4", members.name(),
                                 members.size_text()));
  constexpr Sense sense = Sense::own_moves_its_own;
  const std::size_t size = std::size_t{1} << members.genes();
  const std::size_t width = std::min<std::size_t>(size, 4096);
  std::vector<std::string> automata(size);
  parallel_for(
      size / width, threads,
      [&](std::size_t piece, unsigned) {
        for (std::size_t i = piece * width; i < (piece + 1) * width; ++i)
          automata[i] = letters(minimise(*tabulate(members.member(i), sense), sense));
      },
      progress);
  Behaviours behaviours;
  behaviours.of_member.resize(size);
  std::unordered_map<std::string, std::uint32_t> numbers;
  for (std::uint32_t member = 0; member < size; ++member) {
    const auto [found, is_new] =
        numbers.try_emplace(std::move(automata[member]), static_cast<std::uint32_t>(numbers.size()));
    if (is_new) {
      behaviours.first.push_back(member);
      behaviours.members.push_back(0);
    }
    behaviours.of_member[member] = found->second;
    ++behaviours.members[found->second];
  }
  return behaviours;
}

}  // namespace folk
