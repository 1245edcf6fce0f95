#include <folk/analysis/classes/path_value.h>
#include <folk/analysis/classes/revelation.h>
#include <folk/games/outcome.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace folk {
namespace {

/// Thrown within a piece of work where it is given up.
struct GivenUp {};

}  // namespace

void RevealedSums::add(std::size_t length, Int128 more_own, Int128 more_cooperations) {
  if (own.size() <= length) {
    own.resize(length + 1);
    cooperations.resize(length + 1);
  }
  own[length] += more_own;
  cooperations[length] += more_cooperations;
}

RevealedSums& RevealedSums::operator+=(const RevealedSums& more) {
  for (std::size_t length = 0; length < more.own.size(); ++length)
    add(length, more.own[length], more.cooperations[length]);
  rounded_own += more.rounded_own;
  rounded_cooperations += more.rounded_cooperations;
  beats += more.beats;
  draws += more.draws;
  leaves += more.leaves;
  return *this;
}

Revealed& Revealed::operator+=(const Revealed& more) {
  if (by_asked.size() < more.by_asked.size()) by_asked.resize(more.by_asked.size());
  for (std::size_t asked = 0; asked < more.by_asked.size(); ++asked) by_asked[asked] += more.by_asked[asked];
  if (more.best.any) best.offer(more.best.value, more.best.genes, false);
  if (more.worst.any) worst.offer(more.worst.value, more.worst.genes, true);
  given_up = given_up || more.given_up;
  return *this;
}

void RevealedSums::pack_into(std::string& bytes) const {
  pack(bytes, std::uint64_t{own.size()});
  pack(bytes, std::span<const Int128>(own));
  pack(bytes, std::span<const Int128>(cooperations));
  pack(bytes, rounded_own);
  pack(bytes, rounded_cooperations);
  for (const std::uint64_t count : {beats, draws, leaves}) pack(bytes, count);
}

void RevealedSums::unpack(Unpacker& bytes) {
  const auto lengths = bytes.number<std::uint64_t>();
  for (auto* sums : {&own, &cooperations}) {
    sums->resize(lengths);
    bytes.read(std::span<Int128>(*sums));
  }
  rounded_own = bytes.number<long double>();
  rounded_cooperations = bytes.number<long double>();
  for (auto* count : {&beats, &draws, &leaves}) *count = bytes.number<std::uint64_t>();
}

void ExtremeLeaf::pack_into(std::string& bytes) const {
  pack(bytes, any);
  pack(bytes, value);
  pack(bytes, std::uint64_t{genes.size()});
  pack(bytes, std::span<const unsigned char>(genes));
}

void ExtremeLeaf::unpack(Unpacker& bytes) {
  any = bytes.number<bool>();
  value = bytes.number<double>();
  genes.resize(bytes.number<std::uint64_t>());
  bytes.read(std::span<unsigned char>(genes));
}

std::string Revealed::packed() const {
  std::string bytes;
  pack(bytes, given_up);
  best.pack_into(bytes);
  worst.pack_into(bytes);
  pack(bytes, std::uint64_t{by_asked.size()});
  for (const RevealedSums& sums : by_asked) sums.pack_into(bytes);
  return bytes;
}

void Revealed::unpack(std::string_view packed) {
  Unpacker bytes(packed);
  given_up = bytes.number<bool>();
  best.unpack(bytes);
  worst.unpack(bytes);
  by_asked.resize(bytes.number<std::uint64_t>());
  for (RevealedSums& sums : by_asked) sums.unpack(bytes);
  bytes.end();
}

Revelation::Revelation(const MemoryClass& members, const CycleTable& entrant, const ClassScoreSettings& settings,
                       const WholePayoffs& payoffs)
    : members_(members),
      entrant_(&entrant),
      criterion_(settings.criterion),
      finite_(criterion_.is_finite()),
      exact_(finite_ || criterion_.kind() == Criterion::Kind::mean),
      tolerance_(exact_ ? 0 : score_rounding * payoffs.largest * criterion_.total_weight()),
      last_(finite_ ? criterion_.rounds() : std::numeric_limits<std::uint64_t>::max()),
      marks_(entrant.size() * members.entries(), 0),
      moves_(members.genes(), 0),
      known_(members.genes(), 0),
      sums_(1) {
  for (std::size_t o = 0; o < 4; ++o) {
    const std::size_t exchanged = all_outcomes[o].exchanged().index();
    rounds_[o] = {payoffs.by_outcome[o], payoffs.by_outcome[exchanged], o < 2 ? 1.0 : 0.0};
  }
}

Revealed Revelation::run(std::size_t answers, unsigned ahead, const Progress& progress,
                         std::atomic<std::uint64_t>& leaves, std::uint64_t most_leaves) {
  answers_ = answers;
  ahead_ = ahead;
  progress_ = &progress;
  all_leaves_ = &leaves;
  most_leaves_ = most_leaves;
  found_ = {};
  found_.by_asked.resize(members_.genes() + 1);
  unreported_ = 0;
  try {
    report();
    walk(0, entrant_->start(), 0, 0, 0);
    report();
  } catch (const GivenUp&) {
    forget();
    found_.given_up = true;
  }
  return std::exchange(found_, {});
}

void Revelation::walk(std::size_t t, std::uint32_t entrant, unsigned own, unsigned theirs, unsigned asked) {
  const std::size_t begin = t;
  for (;; ++t) {
    if (t == last_) {
      leaf(t, t, asked);
      break;
    }
    unsigned gene = static_cast<unsigned>(t);
    if (t >= members_.openings()) {
      const unsigned entry = (own << members_.their_memory()) | theirs;
      gene = members_.openings() + entry;
      std::uint32_t& mark = marks_[(entrant >> 1U) * members_.entries() + entry];
      if (mark != 0) {
        leaf(mark - 1, t, asked);
        break;
      }
      mark = static_cast<std::uint32_t>(t + 1);
      marked_.push_back(&mark);
    }
    if (known_[gene] == 0) {
      known_[gene] = 1;
      for (const unsigned move : {0U, 1U}) {
        if (asked < ahead_ && ((answers_ >> (ahead_ - 1 - asked)) & 1U) != move) continue;
        moves_[gene] = static_cast<unsigned char>(move);
        const auto [e, o, h] = after(t, entrant, own, theirs, move);
        walk(t + 1, e, o, h, asked + 1);
      }
      moves_[gene] = 0;
      known_[gene] = 0;
      ++t;
      break;
    }
    std::tie(entrant, own, theirs) = after(t, entrant, own, theirs, moves_[gene]);
  }
  const std::size_t first = std::max<std::size_t>(begin, members_.openings());
  for (; t > first && !marked_.empty(); --t) {
    *marked_.back() = 0;
    marked_.pop_back();
  }
}

std::tuple<std::uint32_t, unsigned, unsigned> Revelation::after(std::size_t t, std::uint32_t entrant, unsigned own,
                                                                unsigned theirs, unsigned move) {
  if (sums_.size() <= t + 1) sums_.resize(t + 2);
  if (weights_.size() <= t) weights_ = round_weights<double>(criterion_, 2 * t + 64);
  const unsigned entrant_move = entrant & 1U;
  sums_[t + 1] = sums_[t] + weights_[t] * rounds_[2 * entrant_move + move];
  const auto shifted = [](unsigned history, unsigned last, unsigned length) {
    return ((history << 1U) | last) & ((1U << length) - 1);
  };
  return {entrant_->next(entrant, move), shifted(own, move, members_.own_memory()),
          shifted(theirs, entrant_move, members_.their_memory())};
}

void Revelation::leaf(std::size_t begin, std::size_t end, unsigned asked) {
  // An answer that was never asked for is taken once.
  if (asked < ahead_ && (answers_ & ((std::size_t{1} << (ahead_ - asked)) - 1)) != 0) return;
  RevealedSums& sums = found_.by_asked[asked];
  const RevealedValues value = path_term<double>(criterion_, begin, end).value(sums_.data(), begin, end);
  // What is compared and, where it is exact, added up: the match, for mean the cycle that it ends in.
  const RevealedValues counted = exact_ && !finite_ ? sums_[end] - sums_[begin] : value;
  if (exact_) {
    // Whole numbers within 2^53.
    sums.add(finite_ ? 0 : end - begin, static_cast<std::int64_t>(counted.own),
             static_cast<std::int64_t>(counted.cooperations));
  } else {
    sums.rounded_own += value.own;
    sums.rounded_cooperations += value.cooperations;
  }
  const double margin = counted.own - counted.theirs;
  if (margin > tolerance_) {
    ++sums.beats;
  } else if (margin >= -tolerance_) {
    ++sums.draws;
  }
  ++sums.leaves;
  found_.best.offer(value.own, moves_, false);
  found_.worst.offer(value.own, moves_, true);
  if (++unreported_ == 1U << 14) report();
}

void Revelation::report() {
  progress_->check();
  if ((*all_leaves_ += std::exchange(unreported_, 0)) > most_leaves_) throw GivenUp();
}

/// As before a walk.
void Revelation::forget() {
  for (; !marked_.empty(); marked_.pop_back()) *marked_.back() = 0;
  std::fill(known_.begin(), known_.end(), static_cast<unsigned char>(0));
  std::fill(moves_.begin(), moves_.end(), static_cast<unsigned char>(0));
  found_ = {};
}

}  // namespace folk
