#include <folk/analysis/play/play_path.h>
#include <folk/games/error.h>

#include <fmt/format.h>

#include <map>
#include <stdexcept>
#include <utility>

namespace folk {

PlayPath PlayPath::exchanged() const {
  PlayPath path = *this;
  for (Outcome& round : path.rounds) round = round.exchanged();
  return path;
}

PlayPath play_path(const Machine& first, const Machine& second, const Criterion& criterion, std::size_t horizon) {
  if (!first.deterministic() || !second.deterministic())
    throw std::logic_error("machines that mix have no single path");
  const bool ends = criterion.is_finite();
  if (ends && criterion.rounds() > most_path_rounds)
    throw UsageError(fmt::format("{}: paths of more than {} rounds are not written out, play fewer",
                                 criterion.to_string(), most_path_rounds));
  const std::size_t most = ends ? criterion.rounds() : horizon > 0 ? horizon : most_path_rounds;
  PlayPath path;
  std::map<std::pair<State, State>, std::size_t> seen;
  State a = first.start();
  State b = second.start();
  while (path.rounds.size() < most) {
    if (!ends) {
      const auto [place, fresh] = seen.emplace(std::pair{a, b}, path.rounds.size());
      if (!fresh) {
        path.cycle = place->second;
        return path;
      }
    }
    const Outcome round{move_of(first, a), move_of(second, b)};
    path.rounds.push_back(round);
    a = first.next(a, round.own, round.theirs);
    b = second.next(b, round.theirs, round.own);
  }
  path.cut = !ends;
  return path;
}

}  // namespace folk
