// One training step of the self-confirming transformer beside the matrix products that it consists of, and its play.

#include <benchmark/benchmark.h>
#include <folk/analysis/parallel.h>
#include <folk/analysis/tournament.h>
#include <folk/sct/initial_parameters.h>
#include <folk/sct/sct_player.h>
#include <folk/sct/tournament_data.h>
#include <folk/sct/trainer.h>
#include <folk/strategies/registry.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <limits>

namespace folk::sct {
namespace {

/// What one step of the paper's setting in the IPD is counted as: 64 windows of 80 tokens, hidden 128, 3 layers,
/// forward and backward; about 6 operations a parameter and token, and attention.
constexpr double nominal_gflop = 20.0;

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
double best_eigen_rate(unsigned threads) {
  double best = 0;
  for (const auto [columns, depth] : {std::array{384, 128}, std::array{512, 128}, std::array{128, 512}})
    best = std::max(best, eigen_rate(5120, columns, depth, threads));
  return best;
}

/// Windows drawn, gradient and optimiser, teacher mode, dropout 0.1. The rates of the best step and of the best product
/// of the same run, in GFLOP/s, and their ratio.
void sct_training_step(benchmark::State& state) {
  const auto threads = static_cast<unsigned>(state.range(0));
  std::vector<Lesson> lessons;
  for (const auto& trajectory : tournament_data(Registry::standard().roster("sct2025"), {}, 100))
    lessons.push_back(imitation(trajectory));
  TrainingSettings settings;
  settings.threads = threads;
  Trainer trainer(settings, std::move(lessons));
  double product = best_eigen_rate(threads);
  double best = std::numeric_limits<double>::infinity();
  for (auto _ : state) best = std::min(best, seconds([&] { benchmark::DoNotOptimize(trainer.step()); }));
  product = std::max(product, best_eigen_rate(threads));
  state.counters["best_step_ms"] = 1e3 * best;
  state.counters["step_GFLOP/s"] = nominal_gflop / best;
  state.counters["Eigen_GFLOP/s"] = product;
  state.counters["ratio"] = nominal_gflop / best / product;
}
BENCHMARK(sct_training_step)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond)->MinTime(3);

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
  for (auto _ : state) benchmark::DoNotOptimize(Tournament(roster, core, settings).signature());
}
BENCHMARK(sct_tournament)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace folk::sct
