#pragma once
// Who moves an agent of the particle world.

#include <folk/mpe/world/block.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace folk::mpe {

/// Which episodes a block holds, and how far they are.
struct Moment {
  std::uint64_t seed = 1;
  std::uint64_t first = 0;  ///< the number of the episode in lane 0; the lanes follow
  std::size_t step = 0;     ///< steps taken so far
};

/// Moves one agent in all episodes of a block. A player sees what its agent observes (scripted players read it off the
/// state), never what others will do. It may draw random numbers from the moment alone, so that an episode is the same
/// in any block, on any thread.
class Player {
public:
  virtual ~Player() = default;

  /// New episodes begin in the block.
  virtual void start(const Layout& layout, const Block& block, std::size_t agent, const Moment& moment);

  /// Writes the agent's actions, rows 2 agent and 2 agent + 1 of block.actions, for the lanes in use.
  virtual void act(const Layout& layout, const Block& block, std::size_t agent, const Moment& moment) = 0;

  /// No more episodes follow. Throws EnvironmentError for a program that has spoken unasked.
  virtual void finish() {}
};

/// Which agents a controller moves.
enum class Side { predators, prey };

inline Side side_of(const Layout& layout, std::size_t agent) {
  return agent + 1 == layout.agents() ? Side::prey : Side::predators;
}

/// The agents of a side, in their order.
std::vector<std::size_t> agents_of(const Layout& layout, Side side);

/// The players of a side, in their agents' order. Each is asked once a step, one after the other; they may share what
/// they know.
using Team = std::vector<std::unique_ptr<Player>>;
using MakeTeam = std::function<Team(const Layout& layout, Side side)>;

/// The team of players who share nothing.
MakeTeam each(std::function<std::unique_ptr<Player>(const Layout& layout, std::size_t agent)> player);

/// A kind of player by its name: what --predators and --prey say.
struct Controller {
  std::string name;

  /// Players for a side. Several teams may play at once, each on a thread of its own.
  MakeTeam team;

  /// True when episodes must be played one at a time, in their order: a program on a pipe.
  bool one_by_one = false;

  /// The policy file that it was named by; empty for all other names.
  std::string file{};

  /// A team's player for one agent, alone.
  std::unique_ptr<Player> player(const Layout& layout, std::size_t agent) const;
};

/// Who plays: the predators' controller and the prey's.
struct Cast {
  Controller predators;
  Controller prey;

  const Controller& of(const Layout& layout, std::size_t agent) const {
    return side_of(layout, agent) == Side::prey ? prey : predators;
  }
  /// Players for all agents.
  Team players(const Layout& layout) const;
  bool one_by_one() const { return predators.one_by_one || prey.one_by_one; }
};

/// The two rows of an agent's actions.
struct ActionRows {
  double* x;
  double* y;
};
inline ActionRows action_rows(const Block& block, std::size_t agent) {
  double* rows = block.actions + 2 * agent * block_lanes;
  return {rows, rows + block_lanes};
}

}  // namespace folk::mpe
