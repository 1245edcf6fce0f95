#include <folk/analysis/replies/bayes_player.h>
#include <folk/analysis/replies/bayes_reply.h>
#include <folk/analysis/replies/better_move.h>
#include <folk/analysis/replies/posterior.h>
#include <folk/games/error.h>
#include <folk/games/rational.h>
#include <folk/strategies/names.h>
#include <folk/strategies/programs/program_rules.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <mutex>
#include <string_view>
#include <utility>

namespace folk {
namespace {

/// The beliefs and moves of one to whom the roster has become impossible.
class Fallback {
public:
  static constexpr double belief = 0.5;

  void start() { last_ = Move::C; }
  void observe(Move theirs) { last_ = theirs; }
  Move move() const { return last_; }

private:
  Move last_ = Move::C;
};

// ---- exact play --------------------------------------------------------------------------------------------------

/// The solved games of one strategy, each made when it is first asked for. All threads share them.
class SolvedGames {
public:
  SolvedGames(std::string name, std::string mend, std::vector<Strategy> roster)
      : name_(std::move(name)),
        mend_(std::move(mend)),
        roster_(std::move(roster)) {}

  std::shared_ptr<const BayesReply> of(const MatchStart& match) {
    if (!match.criterion.is_finite())
      throw UsageError(fmt::format("{} plays under finite:T alone: under {} name {}, which looks {} rounds ahead",
                                   name_, match.criterion.to_string(), mend_, default_lookahead));
    const std::lock_guard lock(mutex_);
    auto& solved = solved_[{to_text(match.payoffs), match.criterion.rounds()}];
    if (!solved) solved = solve(match);
    return solved;
  }

private:
  std::shared_ptr<const BayesReply> solve(const MatchStart& match) const {
    try {
      return std::make_shared<BayesReply>(roster_, match.payoffs, match.criterion.rounds());
    } catch (const UsageError& error) {
      throw UsageError(
          fmt::format("{} (or name {}, which looks {} rounds ahead)", error.what(), mend_, default_lookahead));
    }
  }

  std::string name_;
  std::string mend_;  // the name of the strategy that looks ahead instead
  std::vector<Strategy> roster_;
  std::mutex mutex_;
  std::map<std::pair<std::string, std::uint64_t>, std::shared_ptr<const BayesReply>> solved_;  // by payoffs and rounds
};

class ExactPlayer final : public Player {
public:
  explicit ExactPlayer(std::shared_ptr<SolvedGames> games)
      : games_(std::move(games)) {}

  void start(const MatchStart& match) override {
    reply_ = games_->of(match);
    node_ = reply_->root();
    fallback_.start();
  }

  Move move() override {
    if (node_ == BayesReply::nowhere) {
      belief_ = Fallback::belief;
      return fallback_.move();
    }
    belief_ = reply_->belief(node_);
    return reply_->best(node_);
  }

  void observe(Move own, Move theirs) override {
    node_ = reply_->next(node_, own, theirs);
    fallback_.observe(theirs);
  }

  std::optional<double> belief() const override { return belief_; }

  std::unique_ptr<Player> clone() const override { return std::make_unique<ExactPlayer>(*this); }

private:
  std::shared_ptr<SolvedGames> games_;
  std::shared_ptr<const BayesReply> reply_;
  BayesReply::Node node_ = BayesReply::nowhere;
  Fallback fallback_;
  double belief_ = Fallback::belief;
};

// ---- looking ahead -----------------------------------------------------------------------------------------------

class LookaheadPlayer final : public Player {
public:
  LookaheadPlayer(Posterior posterior, unsigned depth)
      : posterior_(std::move(posterior)),
        depth_(depth) {}

  void start(const MatchStart& match) override {
    posterior_.reset();
    fallback_.start();
    continuation_ = match.criterion.continuation();
    endless_ = !match.criterion.is_finite();
    left_ = endless_ ? 0 : match.criterion.rounds();
    payoffs_ = match.payoffs.numbers();
  }

  Move move() override {
    if (!posterior_.possible()) {
      belief_ = Fallback::belief;
      return fallback_.move();
    }
    belief_ = posterior_.cooperation();
    const unsigned depth = endless_ ? depth_ : static_cast<unsigned>(std::clamp<std::uint64_t>(left_, 1, depth_));
    return better_move(posterior_.action_values(payoffs_, depth, continuation_));
  }

  void observe(Move own, Move theirs) override {
    posterior_.observe(own, theirs);
    fallback_.observe(theirs);
    if (left_ > 0) --left_;
  }

  std::optional<double> belief() const override { return belief_; }

  std::unique_ptr<Player> clone() const override { return std::make_unique<LookaheadPlayer>(*this); }

private:
  Posterior posterior_;
  unsigned depth_;
  std::array<double, 4> payoffs_{};
  double continuation_ = 1;
  bool endless_ = false;
  std::uint64_t left_ = 0;
  Fallback fallback_;
  double belief_ = Fallback::belief;
};

// ---- its name ----------------------------------------------------------------------------------------------------

/// "SPEC;depth=H;slip=E" as SPEC, H and E. Other semicolons belong to SPEC, as in mem1(c;1,0,0,1).
struct Arguments {
  std::string_view spec;
  std::optional<unsigned> depth{};
  double slip = 0;
};

Arguments arguments_of(std::string_view text) {
  Arguments arguments{text};
  constexpr double most_slip = 0.25;
  for (;;) {
    const LastArgument parts = split_last_argument(arguments.spec);
    const auto given = [&](std::string_view option) {
      return parts.last ? value_of_option(*parts.last, option) : std::nullopt;
    };
    if (const auto depth = given("depth"); depth && !arguments.depth)
      arguments.depth = static_cast<unsigned>(parse_whole_number(*depth, "bayes depth", 1, most_lookahead));
    else if (const auto slip = given("slip"); slip && arguments.slip == 0)
      arguments.slip = parse_number(*slip, "bayes slip", 1e-9, most_slip);
    else
      return arguments;
    arguments.spec = parts.spec;
  }
}

/// SPEC with every name as the registry writes it; what is no single name stays as it was given.
std::string canonical(const Registry& registry, std::string_view spec, const Payoffs& payoffs) {
  std::string names;
  for (const auto& labelled : split_list(spec)) {
    const auto [label, rest] = split_label(labelled);
    const std::string item(rest);
    std::string name = item;
    const std::string& known = registry.describe(item).name;
    if (item.find('(') == std::string::npos && known.find_first_of("(<@:") == std::string::npos)
      name = known;
    else if (!item.starts_with('@') && !names_a_program(item))
      if (const auto members = registry.roster(item, payoffs); members.size() == 1) name = members.front().name;
    names += (names.empty() ? "" : ",") + (label ? *label + "=" : "") + name;
  }
  return names;
}

/// Who has weights or slips, or is of a class too large to be listed.
Strategy read_weighted_bayes(const Registry& registry, const Arguments& arguments, const Payoffs& payoffs) {
  auto prior = read_prior(registry, arguments.spec, payoffs);
  prior.slip = arguments.slip;
  const unsigned depth = arguments.depth.value_or(default_lookahead);
  const std::string slip = arguments.slip > 0 ? fmt::format(";slip={}", arguments.slip) : "";
  return bayes_strategy(fmt::format("bayes({};depth={}{})", trimmed(arguments.spec), depth, slip), std::move(prior),
                        depth);
}

Strategy read_bayes(const Registry& registry, std::string_view text, const Payoffs& payoffs) {
  auto [spec, depth, slip] = arguments_of(text);
  if (slip > 0 || has_weights(spec)) return read_weighted_bayes(registry, {spec, depth, slip}, payoffs);
  auto roster = registry.roster(spec, payoffs);
  const bool exact =
      roster.size() <= most_exact_members &&
      std::all_of(roster.begin(), roster.end(), [](const auto& s) { return !s.machine || s.machine->deterministic(); });
  if (!depth && !exact) depth = default_lookahead;
  const std::string names = canonical(registry, spec, payoffs);
  return bayes_strategy(depth ? fmt::format("bayes({};depth={})", names, *depth) : fmt::format("bayes({})", names),
                        std::move(roster), depth);
}

}  // namespace

Strategy bayes_strategy(std::string name, OpponentPrior prior, unsigned depth) {
  if (depth == 0 || depth > most_lookahead)
    throw UsageError(fmt::format("{}: a depth of {} rounds, expected 1 to {}", name, depth, most_lookahead));
  Strategy strategy;
  strategy.name = std::move(name);
  strategy.deterministic = true;
  strategy.plans_ahead = depth;
  strategy.make_player = [posterior = Posterior(std::move(prior)), depth] {
    return std::make_unique<LookaheadPlayer>(posterior, depth);
  };
  return strategy;
}

Strategy bayes_strategy(std::string name, std::vector<Strategy> roster, std::optional<unsigned> depth) {
  auto prior = equal_prior(roster);
  if (depth) return bayes_strategy(std::move(name), std::move(prior), *depth);
  Strategy strategy;
  strategy.name = std::move(name);
  strategy.deterministic = true;
  std::string mend = strategy.name;
  mend.insert(mend.size() - (mend.ends_with(')') ? 1 : 0), fmt::format(";depth={}", default_lookahead));
  const auto games = std::make_shared<SolvedGames>(strategy.name, std::move(mend), std::move(roster));
  strategy.make_player = [games] { return std::make_unique<ExactPlayer>(games); };
  return strategy;
}

void add_bayes(Registry& registry) {
  const auto known = std::make_shared<const Registry>(registry);
  registry.add({"bayes(SPEC;depth=H)",
                {},
                "knows the roster SPEC, learns whom it meets; optimal for finite:T, or H rounds ahead",
                "Kalai & Lehrer, Econometrica 61, 1993"},
               [known](const std::string&, std::string_view text, const Payoffs& payoffs) {
                 return read_bayes(*known, text, payoffs);
               });
}

}  // namespace folk
