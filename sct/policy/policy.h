#pragma once
// A trained transformer with all that must be known to let it play.

#include <folk/games/payoffs.h>
#include <folk/sct/network/architecture.h>

#include <cstdint>
#include <string>
#include <vector>

namespace folk::sct {

/// What stood in the belief slot while the network was trained, and which losses were summed.
enum class LossMode {
  teacher,      ///< the opponent's true action; belief and policy loss (the published program)
  selfconf,     ///< the generated belief, no gradient through it; belief and policy loss (the paper)
  composite,    ///< the generated belief, the gradient flows through it (continuous actions)
  action_only,  ///< policy loss alone (MADT)
};

std::string_view to_string(LossMode mode);

/// Throws UsageError for any other word.
LossMode parse_loss_mode(std::string_view text);

/// Rounds that a policy looks ahead where nothing is said, and the most it can.
inline constexpr unsigned default_plan_depth = 4;
inline constexpr unsigned most_plan_depth = 10;

/// How and on what a policy was trained; what a player needs of it, and what a reader wants to cite.
struct TrainingRecord {
  LossMode mode = LossMode::teacher;
  std::string data;            ///< "tournament", "best-reply", or the folder's name
  std::string roster;          ///< SPEC of the opponents it was trained on
  Payoffs payoffs;             ///< the game, in the file as "T=5,R=3,P=1,S=0"
  std::uint64_t rounds = 100;  ///< of a match
  std::string criterion = "finite:100";
  double return_scale = 100;   ///< returns are divided by it before they are embedded
  double return_target = 300;  ///< the return it is asked for at the start of a match, unscaled
  bool shows_return = true;    ///< else return tokens hold 0, so that a belief cannot say what a wish needs
  unsigned plan_depth = 0;     ///< rounds that it looks ahead on its beliefs at play; 0: its action head moves
  std::uint64_t seed = 1;
  std::uint64_t steps = 0;       ///< of the optimiser
  double final_belief_loss = 0;  ///< end of the training curve
  double final_action_loss = 0;
  std::string code_version;  ///< of Folk
};

/// An architecture, its parameters in the order of ParameterLayout, and how they came about.
struct Policy {
  Architecture architecture;
  std::vector<float> parameters;
  std::vector<std::string> action_names = {"C", "D"};
  TrainingRecord training;
};

}  // namespace folk::sct
