#include <folk/analysis/crew/packing.h>
#include <folk/analysis/play/pair_player.h>
#include <folk/analysis/play/parallel.h>
#include <folk/analysis/play/signature.h>
#include <folk/analysis/play/whole_payoffs.h>
#include <folk/analysis/tournament/blocks.h>
#include <folk/analysis/tournament/standings.h>
#include <folk/analysis/tournament/tournament.h>
#include <folk/games/error.h>
#include <folk/strategies/registry.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace folk {
namespace {

/// Figures for more pairs of behaviours than this would not fit into the memory of a small machine.
constexpr std::size_t most_behaviours = 10'000;

/// The share of the work that pairs which think together are taken for.
double thinking_share(std::size_t thinking, std::size_t pairs) {
  constexpr double weight = 1000;  // of a pair that is thought about, against one that is looked up or counted
  const double thought = weight * static_cast<double>(thinking);
  return thought / (thought + static_cast<double>(pairs - thinking) + 1e-300);
}

double median_of(std::vector<double>& values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return (*middle + *std::max_element(values.begin(), middle)) / 2;
}

}  // namespace

Tournament play_tournament(std::vector<Strategy> roster, std::size_t core, const TournamentSettings& settings,
                           const Progress& progress, const Crew& crew) {
  return {std::move(roster), core, settings, progress, crew};
}

Tournament play_tournament(std::vector<Strategy> roster, const TournamentSettings& settings, const Progress& progress) {
  const std::size_t core = roster.size();
  return play_tournament(std::move(roster), core, settings, progress);
}

Tournament::Tournament(std::vector<Strategy> roster, std::size_t core, const TournamentSettings& settings,
                       const Progress& progress, const Crew& crew)
    : roster_(std::move(roster)),
      core_(core),
      settings_(settings) {
  if (roster_.empty() || core_ == 0 || core_ > roster_.size()) throw UsageError("the roster is empty");
  if (roster_.size() == 1 && !settings_.self_play)
    throw UsageError("a roster of one without self-play has nothing to play");
  refuse_duplicates(roster_);
  scale_payoffs();
  play_pairs(progress, crew);
  average_columns();
  rank();
  sign();
}

void Tournament::scale_payoffs() {
  const auto whole = whole_payoffs(settings_.payoffs);
  scaled_payoffs_ = whole.by_outcome;
  scale_ = whole.scale;
  largest_score_ = settings_.criterion.total_weight() * whole.largest;
  // Whole numbers are exact in a double up to 2^53, and sums of them in a long double up to 2^63.
  if (!(largest_score_ <= 0x1p53 && largest_score_ * static_cast<double>(size()) < 0x1p63))
    throw UsageError(
        fmt::format("{} entrants under {} would score too much to count exactly: play fewer rounds or give "
                    "payoffs of fewer digits",
                    size(), settings_.criterion.to_string()));
}

void Tournament::play_pairs(const Progress& progress, const Crew& crew) {
  PairPlayer player(roster_, settings_, settings_.threads);
  behaviour_of_ = player.behaviour_of();
  behaviours_ = player.behaviours().size();
  if (behaviours_ > most_behaviours)
    throw UsageError(fmt::format("{} strategies that all behave differently: a tournament takes up to {}", behaviours_,
                                 most_behaviours));
  // A behaviour meets itself as its own copy or as another entrant that behaves alike.
  members_.assign(behaviours_, 0);
  for (const std::size_t behaviour : behaviour_of_) ++members_[behaviour];
  scores_.resize(behaviours_ * behaviours_);
  cooperations_.resize(behaviours_ * behaviours_);
  mutual_cooperations_.resize(behaviours_ * (behaviours_ + 1) / 2);
  notes_.resize(behaviours_ * behaviours_);
  if (player.may_sample()) errors_.resize(behaviours_ * behaviours_);
  guesses_.resize(behaviours_);
  for (std::size_t b = 0; b < behaviours_; ++b)
    if (player.is_opaque(b)) guesses_[b].resize(behaviours_);

  Pairs thinking;
  for (std::size_t b = 0; b < behaviours_; ++b)
    for (std::size_t a = 0; a <= b; ++a)
      if (player.thinks_together(a, b) && meet(a, b)) thinking.emplace_back(a, b);
  const double share = thinking_share(thinking.size(), behaviours_ * (behaviours_ + 1) / 2);
  play_row_by_row(player, progress.part(0, 1 - share), crew);
  play_together(player, thinking, progress.part(1 - share, 1), crew);

  for (auto& row : guesses_)
    if (std::all_of(row.begin(), row.end(), [](const Guesses& guesses) { return guesses.all == 0; })) row.clear();
}

void Tournament::play_row_by_row(PairPlayer& player, const Progress& progress, const Crew& crew) {
  const auto blocks = row_blocks(behaviours_);
  const auto each_pair = [&](std::size_t block, const auto& what) {
    for (std::size_t b = blocks[block].begin; b < blocks[block].end; ++b)
      for (std::size_t a = 0; a <= b; ++a) what(a, b);
  };
  crew.run({[&] { return identity(player, 0); }, blocks.size(), settings_.threads,
            [&](std::size_t block, unsigned worker) {
              each_pair(block, [&](std::size_t a, std::size_t b) {
                progress.check();
                if (!player.thinks_together(a, b) && meet(a, b)) store(a, b, player.play(a, b, worker));
              });
            },
            [&](std::size_t block) {
              std::string bytes;
              each_pair(block, [&](std::size_t a, std::size_t b) { pack_pair(bytes, a, b); });
              return bytes;
            },
            [&](std::size_t block, std::string_view bytes) {
              Unpacker unpacker(bytes);
              each_pair(block, [&](std::size_t a, std::size_t b) { unpack_pair(unpacker, a, b); });
              unpacker.end();
            }},
           progress);
}

void Tournament::play_together(const PairPlayer& player, const Pairs& pairs, const Progress& progress,
                               const Crew& crew) {
  if (pairs.empty()) return;
  const auto blocks = pair_blocks(pairs.size(), settings_.repetitions.count());
  const auto part_of = [&](std::size_t block) {
    const auto [begin, end] = blocks[block];
    return Pairs(pairs.begin() + static_cast<std::ptrdiff_t>(begin), pairs.begin() + static_cast<std::ptrdiff_t>(end));
  };
  // Where others are at work too, how far one block has got says little.
  const Progress ends([](double) {}, [progress] { return progress.cancelled(); });
  const auto count = static_cast<double>(blocks.size());
  const auto progress_of = [&](std::size_t block) {
    const auto number = static_cast<double>(block);
    return crew.ranks() > 1 ? ends : progress.part(number / count, (number + 1) / count);
  };
  // A block thinks with all threads.
  crew.run({[&] { return identity(player, 1); }, blocks.size(), 1,
            [&](std::size_t block, unsigned) {
              const auto part = part_of(block);
              const auto results = player.play_together(part, progress_of(block));
              for (std::size_t i = 0; i < part.size(); ++i) store(part[i].first, part[i].second, results[i]);
            },
            [&](std::size_t block) {
              std::string bytes;
              for (const auto& [a, b] : part_of(block)) pack_pair(bytes, a, b);
              return bytes;
            },
            [&](std::size_t block, std::string_view bytes) {
              Unpacker unpacker(bytes);
              for (const auto& [a, b] : part_of(block)) unpack_pair(unpacker, a, b);
              unpacker.end();
            }},
           progress);
}

/// Of all that the pairs' figures depend on; `part`: the pairs that think together, or the others.
std::uint64_t Tournament::identity(const PairPlayer& player, std::size_t part) const {
  Signature signature;
  signature.add("pairs of a roster");
  signature.add(std::uint64_t{part});
  signature.add(settings_.criterion.to_string());
  signature.add(to_text(settings_.payoffs));
  signature.add(settings_.noise.probability());
  signature.add(std::uint64_t{settings_.self_play ? 1U : 0U});
  signature.add(settings_.repetitions.count());
  signature.add(settings_.seed);
  player.sign(signature);
  return signature.value();
}

void Tournament::pack_pair(std::string& bytes, std::size_t a, std::size_t b) const {
  pack(bytes, mutual_cooperations_[common_cell(a, b)]);
  for (const auto& [own, theirs] : {std::pair(a, b), std::pair(b, a)}) {
    const std::size_t at = own * behaviours_ + theirs;
    pack(bytes, scores_[at]);
    pack(bytes, cooperations_[at]);
    pack(bytes, notes_[at].method);
    pack(bytes, notes_[at].wins);
    if (!errors_.empty()) pack(bytes, errors_[at]);
    if (!guesses_[own].empty()) pack(bytes, guesses_[own][theirs]);
  }
}

void Tournament::unpack_pair(Unpacker& bytes, std::size_t a, std::size_t b) {
  mutual_cooperations_[common_cell(a, b)] = bytes.number<double>();
  for (const auto& [own, theirs] : {std::pair(a, b), std::pair(b, a)}) {
    const std::size_t at = own * behaviours_ + theirs;
    scores_[at] = bytes.number<double>();
    cooperations_[at] = bytes.number<double>();
    notes_[at].method = bytes.number<Method>();
    notes_[at].wins = bytes.number<bool>();
    if (!errors_.empty()) errors_[at] = bytes.number<double>();
    if (!guesses_[own].empty()) guesses_[own][theirs] = bytes.number<Guesses>();
  }
}

void Tournament::store(std::size_t a, std::size_t b, const PairResult& result) {
  if (a != b) {
    store_row(a, b, result);
    store_row(b, a, exchanged(result));
    return;
  }
  // Both seats are the same entrant: its figures are the means of the two.
  PairResult mirror = result;
  mirror.weights[1] = mirror.weights[2] = (result.weights[1] + result.weights[2]) / 2;
  mirror.first_guesses += result.second_guesses;
  mirror.first_guesses /= 2;
  // The two are correlated: the mean of their errors is an upper bound.
  mirror.first_error = (result.first_error + result.second_error) / 2;
  store_row(b, b, mirror);
}

void Tournament::store_row(std::size_t a, std::size_t b, const PairResult& result) {
  const std::size_t at = a * behaviours_ + b;
  double own = 0;
  double theirs = 0;
  for (std::size_t o = 0; o < 4; ++o) {
    own += result.weights[o] * scaled_payoffs_[o];
    theirs += exchanged(result).weights[o] * scaled_payoffs_[o];
  }
  scores_[at] = own;
  cooperations_[at] = result.weights[0] + result.weights[1];
  if (a <= b) mutual_cooperations_[common_cell(a, b)] = result.weights[0];
  const bool exact = is_exact(result.method, settings_.criterion);
  notes_[at] = Note{result.method, own - theirs > (exact ? 0 : score_rounding * largest_score_)};
  if (!errors_.empty()) errors_[at] = result.first_error;
  if (!guesses_[a].empty()) guesses_[a][b] = result.first_guesses;
}

double Tournament::score(std::size_t i, std::size_t j) const { return scores_[cell(i, j)] / scale_; }

double Tournament::cooperation(std::size_t i, std::size_t j) const { return cooperations_[cell(i, j)]; }

OutcomeWeights Tournament::outcomes(std::size_t i, std::size_t j) const {
  const double both = mutual_cooperations_[common_cell(behaviour_of_[i], behaviour_of_[j])];
  const auto rest = [](double weight) { return std::max(weight, 0.0); };  // of rounding, no less than nothing is left
  const double own = rest(cooperation(i, j) - both);
  const double theirs = rest(cooperation(j, i) - both);
  return {both, own, theirs, rest(settings_.criterion.total_weight() - both - own - theirs)};
}

Method Tournament::method(std::size_t i, std::size_t j) const { return notes_[cell(i, j)].method; }

double Tournament::standard_error(std::size_t i, std::size_t j) const {
  return errors_.empty() ? 0 : errors_[cell(i, j)];
}

Guesses Tournament::guesses(std::size_t i, std::size_t j) const {
  const auto& row = guesses_[behaviour_of_[i]];
  return row.empty() ? Guesses{} : row[behaviour_of_[j]];
}

bool Tournament::has_beliefs() const {
  return std::any_of(guesses_.begin(), guesses_.end(), [](const auto& row) { return !row.empty(); });
}

std::vector<std::string> Tournament::caveats() const {
  std::vector<std::string> caveats;
  for (const auto& strategy : roster_)
    if (!strategy.caveat.empty() && std::find(caveats.begin(), caveats.end(), strategy.caveat) == caveats.end())
      caveats.push_back(strategy.caveat);
  return caveats;
}

std::optional<double> Tournament::normalised(std::size_t i, std::size_t j) const {
  if (!(column_means_[j] > 0)) return std::nullopt;
  return 100 * score(i, j) / column_means_[j];
}

void Tournament::average_columns() {
  // By behaviour first: entrants that behave alike give and get the same.
  std::vector<long double> members(behaviours_, 0);
  for (std::size_t i = 0; i < core_; ++i) members[behaviour_of_[i]] += 1;
  std::vector<long double> sums(behaviours_, 0);
  for (std::size_t a = 0; a < behaviours_; ++a)
    for (std::size_t b = 0; b < behaviours_; ++b)
      sums[b] += members[a] * static_cast<long double>(scores_[a * behaviours_ + b]);
  column_means_.resize(size());
  for (std::size_t j = 0; j < size(); ++j) {
    long double sum = sums[behaviour_of_[j]];
    auto count = static_cast<double>(core_);
    if (!settings_.self_play && j < core_) {
      sum -= static_cast<long double>(scores_[cell(j, j)]);
      count -= 1;
    }
    column_means_[j] = count > 0 ? static_cast<double>(sum) / scale_ / count : 0;
  }
}

RankingEntry Tournament::entry(std::size_t i) const {
  RankingEntry entry;
  entry.entrant = i;
  long double total = 0;
  double cooperations = 0;
  double normalised_sum = 0;
  // Opponents that behave alike share one sample: their errors add up, those of different ones are independent.
  std::vector<double> error_of(errors_.empty() ? 0 : behaviours_);
  bool all_normalised = true;
  std::vector<double> scores;
  scores.reserve(size());
  const std::size_t row = behaviour_of_[i] * behaviours_;
  for (std::size_t j = 0; j < size(); ++j) {
    if (!played(i, j)) continue;
    const std::size_t at = row + behaviour_of_[j];
    total += static_cast<long double>(scores_[at]);
    if (!guesses_[behaviour_of_[i]].empty()) entry.guesses += guesses_[behaviour_of_[i]][behaviour_of_[j]];
    scores.push_back(scores_[at]);
    cooperations += cooperations_[at];
    if (!errors_.empty()) error_of[behaviour_of_[j]] += errors_[at];
    if (notes_[at].method > entry.method) entry.pairs_of_method = 0;
    entry.method = std::max(entry.method, notes_[at].method);
    if (notes_[at].method == entry.method) ++entry.pairs_of_method;
    entry.wins += notes_[at].wins ? 1 : 0;
    all_normalised = all_normalised && column_means_[j] > 0;
    normalised_sum += scores_[at] / column_means_[j];
  }
  const double weight = settings_.criterion.total_weight();
  const auto count = static_cast<double>(opponents());
  entry.total = total / static_cast<long double>(scale_);
  entry.mean = static_cast<double>(entry.total) / count / weight;
  entry.median = median_of(scores) / scale_ / weight;
  entry.cooperation_rate = cooperations / count / weight;
  for (const double error : error_of) entry.error += error * error;
  entry.error = std::sqrt(entry.error);
  if (all_normalised) entry.normalised = 100 * normalised_sum / scale_ / count;
  return entry;
}

void Tournament::rank() {
  std::vector<RankingEntry> by_behaviour(behaviours_);
  std::vector<std::size_t> first_of(behaviours_);
  for (std::size_t i = size(); i-- > 0;) first_of[behaviour_of_[i]] = i;
  ranking_.resize(size());
  if (settings_.self_play) {
    // Entrants that behave alike then meet the same field.
    parallel_for(behaviours_, settings_.threads,
                 [&](std::size_t b, unsigned) { by_behaviour[b] = entry(first_of[b]); });
    for (std::size_t i = 0; i < size(); ++i) {
      ranking_[i] = by_behaviour[behaviour_of_[i]];
      ranking_[i].entrant = i;
    }
  } else {
    parallel_for(size(), settings_.threads, [&](std::size_t i, unsigned) { ranking_[i] = entry(i); });
  }
  add_up_against_roster();
  std::vector<Standing> standings;
  for (const RankingEntry& entry : ranking_)
    standings.push_back({entry.entrant, entry.total, is_exact(entry.method, settings_.criterion)});
  rank_by_total(standings, score_rounding * largest_score_ / scale_ * static_cast<double>(opponents()));
  auto entries = std::exchange(ranking_, {});
  for (const Standing& standing : standings) {
    ranking_.push_back(std::move(entries[standing.entrant]));
    ranking_.back().rank = standing.rank;
  }
}

void Tournament::add_up_against_roster() {
  std::vector<long double> members(behaviours_, 0);
  for (std::size_t i = 0; i < core_; ++i) members[behaviour_of_[i]] += 1;
  std::vector<long double> sums(behaviours_, 0);
  for (std::size_t a = 0; a < behaviours_; ++a)
    for (std::size_t b = 0; b < behaviours_; ++b)
      sums[a] += members[b] * static_cast<long double>(scores_[a * behaviours_ + b]);
  for (auto& entry : ranking_) {
    const std::size_t i = entry.entrant;
    const long double itself = i < core_ ? static_cast<long double>(scores_[cell(i, i)]) : 0;
    entry.total_against_roster = (sums[behaviour_of_[i]] - itself) / static_cast<long double>(scale_);
  }
}

void Tournament::sign() {
  std::vector<std::uint64_t> rows(behaviours_);
  parallel_for(behaviours_, settings_.threads, [&](std::size_t a, unsigned) {
    Signature row;
    for (std::size_t b = 0; b < behaviours_; ++b) {
      row.add(scores_[a * behaviours_ + b]);
      row.add(cooperations_[a * behaviours_ + b]);
    }
    for (const auto& guesses : guesses_[a]) {
      row.add(guesses.right);
      row.add(guesses.all);
    }
    rows[a] = row.value();
  });
  Signature signature;
  signature.add(settings_.criterion.to_string());
  signature.add(to_text(settings_.payoffs));
  signature.add(settings_.noise.probability());
  signature.add(static_cast<std::uint64_t>(settings_.self_play));
  signature.add(core_);
  for (std::size_t i = 0; i < size(); ++i) {
    signature.add(name(i));
    signature.add(behaviour_of_[i]);
  }
  for (const std::uint64_t row : rows) signature.add(row);
  signature_ = signature.value();
}

}  // namespace folk
