#include <folk/analysis/classes/champion.h>
#include <folk/analysis/classes/class_tournament.h>
#include <folk/analysis/play/parallel.h>
#include <folk/games/random.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

namespace folk {
namespace {

constexpr std::size_t searches = 8;

using Genes = std::vector<bool>;

/// Genes that play asks for when the member plays as it does and the opponent anything.
std::vector<std::size_t> asked_genes(const MemoryClass& members, const Genes& genes) {
  const unsigned openings = members.openings();
  const auto shifted = [](unsigned history, unsigned last, unsigned length) {
    return ((history << 1U) | last) & ((1U << length) - 1);
  };
  std::vector<bool> asked(genes.size(), false);
  std::vector<std::pair<unsigned, unsigned>> states{{0, 0}};
  for (unsigned round = 0; round < openings; ++round) {
    asked[round] = true;
    std::vector<std::pair<unsigned, unsigned>> next;
    for (const auto& [own, theirs] : states)
      for (const unsigned move : {0U, 1U})
        next.emplace_back(shifted(own, genes[round] ? 1U : 0U, members.own_memory()),
                          shifted(theirs, move, members.their_memory()));
    std::sort(next.begin(), next.end());
    next.erase(std::unique(next.begin(), next.end()), next.end());
    states = std::move(next);
  }
  while (!states.empty()) {
    const auto [own, theirs] = states.back();
    states.pop_back();
    const std::size_t gene = openings + ((own << members.their_memory()) | theirs);
    if (asked[gene]) continue;
    asked[gene] = true;
    for (const unsigned move : {0U, 1U})
      states.emplace_back(shifted(own, genes[gene] ? 1U : 0U, members.own_memory()),
                          shifted(theirs, move, members.their_memory()));
  }
  std::vector<std::size_t> list;
  for (std::size_t gene = 0; gene < asked.size(); ++gene)
    if (asked[gene]) list.push_back(gene);
  return list;
}

/// Genes that play does not ask for become C, so that a behaviour has one text.
Genes canonical(const MemoryClass& members, const Genes& genes) {
  Genes kept(genes.size(), false);
  for (const std::size_t gene : asked_genes(members, genes)) kept[gene] = genes[gene];
  return kept;
}

struct Scored {
  Genes genes;
  ClassScore score;

  bool better_than(const Scored& other) const {
    if (score.exact_mean && *score.exact_mean != *other.score.exact_mean)
      return *score.exact_mean > *other.score.exact_mean;
    return !score.exact_mean && score.mean > other.score.mean;
  }
};

class Search {
public:
  Search(const MemoryClass& members, const ChampionSettings& settings, std::size_t number, std::uint64_t evaluations,
         const Progress& progress)
      : members_(members),
        settings_(settings),
        random_({settings.seed, number, 0, 0}),
        left_(evaluations),
        progress_(&progress) {
    settings_.threads = 1;
  }

  /// Climbs from permanent defection, then again and again from where some genes of the best are turned over.
  void run() {
    std::optional<Scored> here = scored(Genes(members_.genes(), true));
    while (left_ > 0) {
      if (here) climb(*here);
      if (here && (!best_ || here->better_than(*best_))) best_ = here;
      Genes genes = best_ ? best_->genes : Genes(members_.genes(), true);
      const auto asked = asked_genes(members_, genes);
      for (std::uint64_t turned = 2 + random_() % 4; turned > 0; --turned) {
        const std::size_t gene = asked[random_() % asked.size()];
        genes[gene] = !genes[gene];
      }
      here = scored(genes);
    }
  }

  const std::optional<Scored>& best() const { return best_; }
  std::uint64_t evaluations() const { return evaluations_; }
  std::uint64_t passed_over() const { return passed_over_; }
  std::uint64_t local_optima() const { return local_optima_; }

private:
  std::optional<Scored> scored(const Genes& genes) {
    if (left_ == 0) return std::nullopt;
    --left_;
    progress_->check();
    try {
      Genes kept = canonical(members_, genes);
      ClassScore score = score_against(members_, members_.member(kept), settings_);
      ++evaluations_;
      return Scored{std::move(kept), std::move(score)};
    } catch (const TooManyKinds&) {
      ++passed_over_;
      return std::nullopt;
    }
  }

  /// To a member that no single gene makes better: the first better neighbour is taken, genes in random order.
  void climb(Scored& here) {
    for (bool better = true; better && left_ > 0;) {
      better = false;
      auto genes = asked_genes(members_, here.genes);
      for (std::size_t i = genes.size(); i > 1; --i) std::swap(genes[i - 1], genes[random_() % i]);
      for (const std::size_t gene : genes) {
        Genes turned = here.genes;
        turned[gene] = !turned[gene];
        auto neighbour = scored(turned);
        if (!neighbour || !neighbour->better_than(here)) continue;
        here = *std::move(neighbour);
        better = true;
        break;
      }
      if (!better && left_ > 0) ++local_optima_;
    }
  }

  MemoryClass members_;
  ChampionSettings settings_;
  RandomStream random_;
  std::uint64_t left_;
  const Progress* progress_;
  std::optional<Scored> best_;
  std::uint64_t evaluations_ = 0;
  std::uint64_t passed_over_ = 0;
  std::uint64_t local_optima_ = 0;
};

Champion proved(const MemoryClass& members, const ChampionSettings& settings, const Progress& progress) {
  const ClassTournament tournament =
      play_class(members, {settings.payoffs, settings.criterion, true, settings.threads}, progress);
  Champion champion;
  champion.proved = true;
  champion.evaluations = tournament.size();
  const auto& ranking = tournament.ranking();
  champion.equals = static_cast<std::uint64_t>(
      std::count_if(ranking.begin(), ranking.end(), [](const MemberPlace& place) { return place.rank == 1; }));
  champion.member = tournament.name(ranking[0].member);
  ClassScoreSettings all = settings;
  all.most_leaves = ClassScoreSettings{}.most_leaves;
  champion.score = score_against(members, members.member(ranking[0].member), all);
  return champion;
}

}  // namespace

Champion champion_of(const MemoryClass& members, const ChampionSettings& settings, const Progress& progress) {
  if (members.entries() <= most_ranked_entries) return proved(members, settings, progress);
  std::vector<Search> all;
  for (std::size_t i = 0; i < searches; ++i)
    all.emplace_back(members, settings, i,
                     settings.evaluations / searches + (i < settings.evaluations % searches ? 1 : 0), progress);
  parallel_for(
      searches, settings.threads, [&](std::size_t i, unsigned) { all[i].run(); }, progress);
  Champion champion;
  const Scored* best = nullptr;
  for (const Search& search : all) {
    champion.evaluations += search.evaluations();
    champion.passed_over += search.passed_over();
    champion.local_optima += search.local_optima();
    if (search.best() && (best == nullptr || search.best()->better_than(*best))) best = &*search.best();
  }
  if (best == nullptr) throw TooManyKinds("every member that was tried tells too many kinds of opponents apart");
  champion.member = members.member(best->genes).name();
  champion.score = best->score;
  return champion;
}

}  // namespace folk
