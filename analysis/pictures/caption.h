#pragma once
// What stands at the foot of every picture: what was played, and which Folk drew it.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace folk {

/// What a reader must know of the figures in a picture. What does not apply stays empty and is not said: an automaton
/// has no criterion.
struct Caption {
  std::string game;       ///< "prisoner's dilemma (T=5,R=3,P=1,S=0)", the title of a stage game, a scenario
  std::string criterion;  ///< "finite:100", "discounted:0.9"; of the particle world "25 steps"
  double noise = 0;       ///< each move flips with this probability; 0 is not said
};

/// The caption on one line, as visible_text shows it, its parts set apart by " · " and Folk's version the last:
/// "prisoner's dilemma (T=5,R=3,P=1,S=0) · finite:100 · noise 0.01 · Folk 0.2.0". A game or a criterion of more than
/// 100 characters ends in "...".
std::string caption_text(const Caption& caption);

/// The same in lines of at most `most` characters where no part is longer than that.
std::vector<std::string> caption_lines(const Caption& caption, std::size_t most);

}  // namespace folk
