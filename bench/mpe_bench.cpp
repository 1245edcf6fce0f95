// The particle world beside the program that people write in numpy, the memory it runs in, and the arithmetic it needs;
// an update of MATD3 beside matrix products of its shapes and PyTorch. Ratios within one run are what counts.

#include <benchmark/benchmark.h>
#include <folk/analysis/play/parallel.h>
#include <folk/mpe/evaluation/episodes.h>
#include <folk/mpe/online/learner.h>
#include <folk/mpe/players/policy_file.h>
#include <folk/mpe/players/scripted.h>
#include <folk/mpe/players/transformer_player.h>
#include <folk/mpe/world/batch.h>
#include <folk/sct/network/initial_parameters.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>

namespace folk::mpe {
namespace {

constexpr std::array scenarios = {"simple_tag", "simple_world"};

template <class Work>
double seconds(Work&& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// The number that a peer's script prints after `before`; 0 when it cannot run.
double peer_figure(const std::string& command, const char* before) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(::popen((command + " 2>/dev/null").c_str(), "r"),
                                                             ::pclose);
  std::string text;
  std::array<char, 256> block{};
  while (pipe && std::fgets(block.data(), block.size(), pipe.get()) != nullptr) text += block.data();
  const auto at = text.find(before);
  return at == std::string::npos ? 0 : std::atof(text.c_str() + at + std::strlen(before));
}

/// (Debian's OpenBLAS does not know newer processors: without being told it takes kernels half as fast.)
std::string peer(const std::string& script) {
  return "OPENBLAS_CORETYPE=${OPENBLAS_CORETYPE-SkylakeX} /usr/bin/python3 " + std::string(FOLK_SOURCE_DIR) +
         "/bench/peers/" + script;
}

/// Actions that keep agents moving and meeting, other ones for each lane.
void fill_actions(const Layout& layout, const Block& block, std::size_t salt) {
  for (std::size_t i = 0; i < layout.action_rows() * block_lanes; ++i)
    block.actions[i] = std::sin(static_cast<double>(7 * i + 13 * salt));
}

/// 1,024 episodes from reset to end, again and again, with given actions, a block at a time: steps a second.
double steps_a_second(const Scenario& scenario, unsigned threads) {
  constexpr std::size_t episodes = 1024;
  constexpr std::size_t repetitions = 100;
  std::vector<Batch> batches;  // one a thread
  for (unsigned t = 0; t < threads; ++t) {
    auto& batch = batches.emplace_back(scenario, episodes / threads);
    for (std::size_t b = 0; b < batch.blocks(); ++b) fill_actions(batch.layout(), batch.block(b), b);
  }
  const double time = seconds([&] {
    parallel_for(threads, threads, [&](std::size_t t, unsigned) {
      Batch& batch = batches[t];
      for (std::size_t n = 0; n < repetitions; ++n) {
        batch.reset(n, t * batch.size());
        for (std::size_t b = 0; b < batch.blocks(); ++b)
          for (std::size_t s = 0; s < scenario.episode_steps; ++s) step(batch.layout(), batch.block(b));
      }
    });
  });
  return static_cast<double>(episodes * scenario.episode_steps * repetitions) / time;
}

/// 1,024 episodes at once, resets, observations and rewards included, beside the numpy twin in the same run.
void mpe_world_beside_numpy(benchmark::State& state) {
  const std::string name = scenarios[static_cast<std::size_t>(state.range(0))];
  const auto threads = static_cast<unsigned>(state.range(1));
  const std::string twin = peer("mpe_numpy.py") + " --scenario " + name + " --steps 3000";
  double numpy = peer_figure(twin, (name + " ").c_str());
  double best = 0;
  for (auto _ : state) best = std::max(best, steps_a_second(Scenario::named(name), threads));
  numpy = std::max(numpy, peer_figure(twin, (name + " ").c_str()));
  if (numpy == 0) return state.SkipWithError("the numpy twin does not run: apt-get install python3-numpy");
  state.SetLabel(name);
  state.counters["steps/s"] = best;
  state.counters["numpy_steps/s"] = numpy;
  state.counters["ratio"] = best / numpy;
}
BENCHMARK(mpe_world_beside_numpy)->ArgsProduct({{0, 1}, {1, 2}})->UseRealTime()->Unit(benchmark::kMillisecond);

/// Bytes that a step of an episode reads and writes.
double bytes_a_step(const Layout& layout) {
  const std::size_t moving = 4 * layout.agents();
  const std::size_t rows =
      layout.state_rows() + moving + layout.action_rows() + layout.observation_rows() + layout.reward_rows();
  return 8.0 * static_cast<double>(rows);
}

/// A batch that does not fit the caches, stepped whole step by step, beside a copy of as much memory: both read and
/// write on two threads.
void mpe_world_beside_copy(benchmark::State& state) {
  const std::string name = scenarios[static_cast<std::size_t>(state.range(0))];
  const auto episodes = static_cast<std::size_t>(state.range(1));
  constexpr unsigned threads = 2;
  Batch batch(Scenario::named(name), episodes, threads);
  batch.reset(1);
  for (std::size_t b = 0; b < batch.blocks(); ++b) fill_actions(batch.layout(), batch.block(b), b);
  const std::size_t words = std::size_t{1} << 27U;  // 1 GiB
  const std::size_t half = words / 2;
  AlignedDoubles memory(words, 1.0);
  double copy = 0;
  double best = 0;
  for (auto _ : state) {
    const double copying = seconds([&] {
      parallel_for(threads, threads, [&](std::size_t t, unsigned) {
        std::memcpy(memory.data() + half + t * half / threads, memory.data() + t * half / threads,
                    half / threads * sizeof(double));
      });
    });
    copy = std::max(copy, 2.0 * static_cast<double>(half * sizeof(double)) / copying);
    const double stepping = seconds([&] { batch.step(); });
    best = std::max(best, static_cast<double>(batch.size()) / stepping);
  }
  state.SetLabel(name);
  state.counters["steps/s"] = best;
  state.counters["GB/s"] = 1e-9 * best * bytes_a_step(batch.layout());
  state.counters["copy_GB/s"] = 1e-9 * copy;
  state.counters["ratio"] = best * bytes_a_step(batch.layout()) / copy;
}
BENCHMARK(mpe_world_beside_copy)
    ->ArgsProduct({{0, 1}, {1'000'000}})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond)
    ->MinTime(4);

/// Whole episodes, played a block at a time: the cost of a step must not depend on how many there are.
void mpe_episodes(benchmark::State& state) {
  const bool networks = state.range(0) != 0;
  const auto episodes = static_cast<std::size_t>(state.range(1));
  const auto scenario = Scenario::named("simple_tag");
  const Layout layout(scenario);
  const auto policy = [&](Side side) {
    return policy_controller("untrained", untrained_policy(scenario, side, 1), side, scenario);
  };
  const Cast cast = networks ? Cast{policy(Side::predators), policy(Side::prey)} : Cast{lead_pursuit(), still_player()};
  double best = 0;
  for (auto _ : state) {
    const double time = seconds([&] {
      play_episodes(layout, cast, {1, 0, episodes, 2}, [](std::size_t) { return std::make_unique<Watcher>(); });
    });
    best = std::max(best, static_cast<double>(episodes * scenario.episode_steps) / time);
  }
  state.SetLabel(networks ? "networks" : "scripted");
  state.counters["steps/s"] = best;
}
BENCHMARK(mpe_episodes)
    ->ArgsProduct({{0, 1}, {1'000, 10'000, 100'000, 1'000'000}})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

/// Rows x depth times depth x columns in Eigen on so many threads, in GFLOP/s: the best of some repetitions.
double eigen_rate(Index rows, Index columns, Index depth, unsigned threads) {
  const Matrix<float> b = Matrix<float>::Random(depth, columns);
  std::vector<Matrix<float>> a, c;
  for (unsigned t = 0; t < threads; ++t) {
    a.emplace_back(Matrix<float>::Random(rows / threads, depth));
    c.emplace_back(Matrix<float>::Zero(rows / threads, columns));
  }
  constexpr int products = 200;  // at a time, so that starting the threads does not count
  const double gflop = 2e-9 * products * static_cast<double>(rows * columns * depth);
  double best = 0;
  for (int repetition = 0; repetition < 8; ++repetition)
    best = std::max(best, gflop / seconds([&] {
                            parallel_for(threads, threads, [&](std::size_t t, unsigned) {
                              for (int i = 0; i < products; ++i) c[t].noalias() = a[t] * b;
                            });
                          }));
  return best;
}

/// What the products of an update need, in GFLOP: all learning agents, critics always, actors every actor_every()
/// times.
double nominal_gflop(const Learner& learner, const OnlineSettings& settings) {
  const auto weights = [](const MlpShape& shape, std::size_t from) {
    std::size_t sum = 0;
    for (std::size_t k = from; k < shape.layers(); ++k) sum += shape.widths()[k] * shape.widths()[k + 1];
    return static_cast<double>(sum);
  };
  double products = 0;  // multiplications of an example
  for (std::size_t agent = 0; agent < learner.agents(); ++agent) {
    const auto& critic = learner.critic_shape(agent);
    const auto& actor = learner.actor_shape(agent);
    products += weights(actor, 0);  // the target's action
    products += static_cast<double>(settings.critics()) * (3 * weights(critic, 0) + weights(critic, 1));
    const double step = 2 * weights(actor, 0) + weights(actor, 1) + weights(critic, 0) + weights(critic, 1) +
                        2.0 * static_cast<double>(settings.hidden);
    products += step / static_cast<double>(settings.actor_every());
  }
  return 2e-9 * products * static_cast<double>(settings.batch);
}

/// An update of MATD3: 3 predators, batch 1024, beside Eigen's products of its largest shape and PyTorch's update.
void mpe_update(benchmark::State& state) {
  const auto threads = static_cast<unsigned>(state.range(0));
  OnlineSettings settings;
  settings.threads = threads;
  const Layout layout(Scenario::named("simple_tag"));
  Batch batch(layout.scenario(), round_episodes);
  ReplayMemory memory(layout, 100'000);
  for (std::size_t round = 0; round < 60; ++round) {
    batch.reset(round);
    const Block block = batch.block(0);
    memory.begin_round();
    for (std::size_t s = 0; s <= layout.scenario().episode_steps; ++s) {
      memory.observe(layout, block, s);
      fill_actions(layout, block, s);
      memory.act(layout, block, s);
      if (s == layout.scenario().episode_steps) break;
      step(layout, block);
      memory.reward(layout, block, s);
    }
  }
  Learner learner(layout, settings);
  double eigen = std::max(eigen_rate(1024, 64, 70, threads), eigen_rate(1024, 64, 64, threads));
  const std::string script = peer("mpe_torch_update.py") + " --updates 200 --threads 1";  // its fastest setting here
  double torch = peer_figure(script, "median ");
  double best = INFINITY;
  constexpr int updates = 20;
  for (auto _ : state)
    best = std::min(best, seconds([&] {
                            for (int i = 0; i < updates; ++i) learner.update(memory, 1e-3);
                          }) / updates);
  const double again = peer_figure(script, "median ");
  torch = torch == 0 ? again : std::min(torch, again);
  state.counters["update_ms"] = 1e3 * best;
  state.counters["GFLOP/s"] = nominal_gflop(learner, settings) / best;
  state.counters["Eigen_GFLOP/s"] = eigen;
  state.counters["share"] = nominal_gflop(learner, settings) / best / eigen;
  if (torch > 0) {
    state.counters["torch_ms"] = torch;
    state.counters["times_torch"] = torch / (1e3 * best);
  }
}
BENCHMARK(mpe_update)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond)->MinTime(3);

/// 100 episodes of a transformer at the paper's setting (hidden 128, 3 layers, context 20), beliefs and actions, from
/// reset to end: keys and values are kept for the first 20 steps, then the window slides and is thought through anew.
void mpe_transformer_episodes(benchmark::State& state) {
  constexpr std::size_t episodes = 100;
  const Layout layout(Scenario::named("simple_tag"));
  TransformerPolicy policy;
  policy.scenario = layout.scenario().name;
  sct::Architecture base;
  base.readout = sct::Readout::cat;
  policy.architecture = particle_architecture(layout.scenario(), base);
  policy.parameters = sct::initial_parameters(policy.architecture, 1);
  policy.scale = {{0, 0, 0}, {1, 1, 1}};
  const auto mind = std::make_shared<const TransformerMind>(policy);
  const Cast cast{transformer_controller("sct", mind, layout.scenario()), random_player()};
  for (auto _ : state)
    benchmark::DoNotOptimize(score_episodes(layout, cast, {1, 0, episodes, static_cast<unsigned>(state.range(0))}));
  state.counters["episodes/s"] =
      benchmark::Counter(static_cast<double>(episodes), benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(mpe_transformer_episodes)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace folk::mpe
