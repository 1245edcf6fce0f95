#pragma once
// Two-player games in Gambit's .nfg files ("NFG 1 R ...", Gambit's manual, "The strategic game (.nfg) file formats").

#include <folk/games/stage_game.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace folk {

/// The two bodies of an .nfg file: the payoffs one after the other, or numbered outcomes and the number of each
/// profile's outcome (0: no outcome, payoffs zero). In both, the first player's action changes fastest.
enum class NfgForm { payoff, outcome };

/// An .nfg file with more profiles (rows times columns) is refused.
inline constexpr std::size_t most_nfg_profiles = 1'000'000;

/// Reads either form, whole numbers, decimals and fractions exactly. Actions without a name ("" or given by their
/// number only) are named by their position, "1", "2", ...; actions of one player that share a name are numbered,
/// "leave_1", "leave_2"; the comment becomes StageGame::comment(). Outcomes' names are not kept. Throws InputFileError
/// "source:LINE: what; what to do" on anything else, also on games of other than two players.
StageGame read_nfg(std::string_view text, const std::string& source);

/// read_nfg of a file's text. Throws InputFileError also when the file cannot be read.
StageGame read_nfg_file(const std::filesystem::path& path);

/// The game as Gambit lays it out: read_nfg gives back the same game, title, players and comment, and an outcome file
/// that Gambit wrote comes back byte for byte when its outcomes are unnamed and in the profiles' order.
std::string write_nfg(const StageGame& game, NfgForm form);

}  // namespace folk
