// Training steps of the self-confirming transformer beside the matrix products that they consist of, and its play.

#include <benchmark/benchmark.h>
#include <folk/analysis/play/parallel.h>
#include <folk/analysis/tournament/tournament.h>
#include <folk/games/outcome.h>
#include <folk/sct/data/tournament_data.h>
#include <folk/sct/network/initial_parameters.h>
#include <folk/sct/policy/planner.h>
#include <folk/sct/policy/sct_player.h>
#include <folk/sct/training/trainer.h>
#include <folk/strategies/registry.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <limits>

namespace folk::sct {
namespace {

/// What one training step is counted as, in GFLOP: forward and backward, 6 operations a number and token in the
/// matrices of the blocks and a number and round in the heads' (embeddings come free), and attention as if no token
/// were left out. For the paper's 64 windows of 20 rounds, hidden 128 and 3 layers: 20.0 in the IPD, 44.6 in the
/// particle world. Modes of two passes count the blocks twice.
double nominal_gflop(const Architecture& architecture, LossMode mode, std::size_t windows) {
  const bool twice = mode == LossMode::selfconf || mode == LossMode::composite;
  std::size_t blocks = 0;
  std::size_t heads = 0;
  const ParameterLayout layout(architecture);
  for (const auto& tensor : layout.tensors()) {
    if (tensor.shape.size() < 2 || tensor.name.starts_with("embed")) continue;
    const bool mix = tensor.name.starts_with("opo_obs_cat");  // is used once an agent
    (tensor.name.starts_with("h.") ? blocks : heads) += tensor.size() * (mix ? architecture.agents : 1);
  }
  const std::size_t tokens = architecture.context * architecture.round_tokens();
  const std::size_t attention = architecture.layers * 12 * tokens * tokens * architecture.hidden;
  const std::size_t window = (twice ? 2 : 1) * (6 * blocks * tokens + attention) + 6 * heads * architecture.context;
  return 1e-9 * static_cast<double>(window * windows);
}

template <class Work>
double seconds(Work&& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Rows x depth times depth x columns in Eigen, each thread with its share of the rows: the best of some repetitions,
/// in GFLOP/s.
double eigen_rate(Index rows, Index columns, Index depth, unsigned threads) {
  const Matrix<float> b = Matrix<float>::Random(depth, columns);
  std::vector<Matrix<float>> a, c;
  for (unsigned t = 0; t < threads; ++t) {
    a.emplace_back(Matrix<float>::Random(rows / threads, depth));
    c.emplace_back(Matrix<float>::Zero(rows / threads, columns));
  }
  constexpr int products = 8;  // at a time, so that starting the threads does not count
  const double gflop = 2e-9 * products * static_cast<double>(rows * columns * depth);
  double best = std::numeric_limits<double>::infinity();
  for (int repetition = 0; repetition < 12; ++repetition)
    best = std::min(best, seconds([&] {
                      parallel_for(threads, threads, [&](std::size_t t, unsigned) {
                        for (int i = 0; i < products; ++i) c[t].noalias() = a[t] * b;
                      });
                    }));
  return gflop / best;
}

/// The three products of a block.
double best_eigen_rate(Index tokens, unsigned threads) {
  double best = 0;
  for (const auto [columns, depth] : {std::array{384, 128}, std::array{512, 128}, std::array{128, 512}})
    best = std::max(best, eigen_rate(tokens, columns, depth, threads));
  return best;
}

/// Takes steps. The rates of the best one and of the best product of the same run, in GFLOP/s, and their ratio.
template <class Step>
void beside_eigen(benchmark::State& state, const TrainingSettings& settings, Step&& step) {
  const auto& architecture = settings.architecture;
  const auto tokens = index(settings.windows.windows * architecture.context * architecture.round_tokens());
  const double gflop = nominal_gflop(architecture, settings.mode, settings.windows.windows);
  double product = best_eigen_rate(tokens, settings.threads);
  double best = std::numeric_limits<double>::infinity();
  for (auto _ : state) best = std::min(best, seconds([&] { benchmark::DoNotOptimize(step()); }));
  product = std::max(product, best_eigen_rate(tokens, settings.threads));
  state.counters["best_step_ms"] = 1e3 * best;
  state.counters["step_GFLOP/s"] = gflop / best;
  state.counters["Eigen_GFLOP/s"] = product;
  state.counters["ratio"] = gflop / best / product;
}

/// The IPD's: windows drawn, gradient and optimiser, teacher mode, dropout 0.1.
void sct_training_step(benchmark::State& state) {
  std::vector<Lesson> lessons;
  for (const auto& trajectory : tournament_data(Registry::standard().roster("sct2025"), {}, 100))
    lessons.push_back(imitation(trajectory));
  TrainingSettings settings;
  settings.threads = static_cast<unsigned>(state.range(0));
  Trainer trainer(settings, std::move(lessons));
  beside_eigen(state, settings, [&] { return trainer.step(); });
}
BENCHMARK(sct_training_step)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond)->MinTime(3);

/// The paper's network for three predators of the particle world.
Architecture predators() {
  Architecture architecture;
  architecture.time_rows = 26;
  architecture.observation_size = 16;
  architecture.agents = 3;
  architecture.discrete = false;
  architecture.readout = Readout::cat;
  return architecture;
}

/// Windows of random numbers in (-1, 1).
Batch<float> random_windows(const Architecture& architecture, std::size_t windows) {
  RandomStream random({1, 0, 0, 0});
  const auto numbers = [&](std::size_t count) {
    std::vector<float> drawn(count);
    for (auto& x : drawn) x = static_cast<float>(2 * random.uniform() - 1);
    return drawn;
  };
  Batch<float> batch;
  batch.window_rounds.assign(windows, architecture.context);
  for (std::size_t w = 0; w < windows; ++w)
    for (std::size_t t = 0; t < architecture.context; ++t)
      batch.timesteps.push_back(static_cast<std::int32_t>(w % (architecture.time_rows - architecture.context + 1) + t));
  const std::size_t rounds = batch.rounds();
  batch.returns = numbers(rounds);
  batch.observations = numbers(rounds * architecture.agents * architecture.observation_size);
  batch.opponent.numbers = numbers(rounds * architecture.action_size);
  batch.own.numbers = numbers(rounds * architecture.agents * architecture.action_size);
  return batch;
}

/// The particle world's (160 tokens a window): gradient and optimiser for one batch that is there, in a mode, dropout
/// 0.1.
void sct_predators_step(benchmark::State& state) {
  TrainingSettings settings;
  settings.architecture = predators();
  settings.mode = state.range(1) == 0 ? LossMode::teacher : LossMode::selfconf;
  settings.threads = static_cast<unsigned>(state.range(0));
  state.SetLabel(state.range(1) == 0 ? "teacher" : "selfconf");
  const auto batch = random_windows(settings.architecture, settings.windows.windows);
  const Network<float> network(settings.architecture);
  BatchGradient<float> batch_gradient(network, settings.mode, settings.threads);
  auto parameters = initial_parameters(settings.architecture, settings.seed);
  std::vector<float> gradient(parameters.size());
  AdamWState<float> optimiser;
  beside_eigen(state, settings, [&] {
    const StepDropout dropout{settings.dropout, settings.seed, optimiser.steps};
    const auto losses = batch_gradient(parameters, batch, dropout, gradient);
    adamw_step<float>(settings.optimiser, batch_gradient.touched(), gradient, optimiser, parameters);
    return losses;
  });
}
BENCHMARK(sct_predators_step)->ArgsProduct({{1, 2}, {0, 1}})->UseRealTime()->Unit(benchmark::kMillisecond)->MinTime(3);

/// `ipd-tournament --strategies sct2025 --include sct --rounds 100`, the policy read and of the paper's size.
/// Untrained: it takes as long.
void sct_tournament(benchmark::State& state) {
  Policy policy;
  policy.parameters = initial_parameters(policy.architecture, 1);
  const auto mind = std::make_shared<const Mind>(policy);
  auto roster = Registry::standard().roster("sct2025");
  const std::size_t core = roster.size();
  roster.push_back(transformer("sct", mind));
  TournamentSettings settings;
  settings.threads = static_cast<unsigned>(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(play_tournament(roster, core, settings).signature());
}
BENCHMARK(sct_tournament)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond);

/// One planned move in the middle of a match, by a network of the size of sct-plan. Untrained it holds every move
/// possible, so that all 4^(depth - 1) plays are looked into; `situations` are those in which it was asked for its
/// belief.
void sct_planned_move(benchmark::State& state) {
  Policy policy;
  policy.architecture.hidden = 64;
  policy.architecture.heads = 4;
  policy.architecture.context = 100;
  policy.architecture.observation_size = 6 * observation_size;
  policy.parameters = initial_parameters(policy.architecture, 1);
  const Mind mind(policy);
  Thinker thinker(mind);
  Planner planner(mind, {.depth = static_cast<unsigned>(state.range(0))});
  MatchSoFar so_far = begin_match(0);
  for (std::size_t t = 0; t < 50; ++t) {
    const Outcome played = all_outcomes[t * t % 4];
    add_round(so_far, played.own, played.theirs, Move::C, 0);
  }
  thinker.believe(so_far);
  Plan plan;
  for (auto _ : state) benchmark::DoNotOptimize(plan = planner.plan(thinker, so_far, Payoffs{}.numbers(), 50));
  state.counters["situations"] = static_cast<double>(plan.situations);
}
BENCHMARK(sct_planned_move)->Arg(2)->Arg(4)->Arg(6)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace folk::sct
