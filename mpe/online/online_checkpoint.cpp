#include <folk/games/error.h>
#include <folk/mpe/online/online_checkpoint.h>
#include <folk/sct/files/record_bytes.h>
#include <folk/sct/training/checkpoint.h>

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace folk::mpe {
namespace {

constexpr sct::RecordKind kind{"FOLKMPE1", 1, "mpe-train"};

void put_network(sct::RecordWriter& writer, const LearningNetwork& network) {
  writer.floats(network.parameters);
  writer.floats(network.target);
  writer.word(network.optimiser.steps);
  writer.floats(network.optimiser.first);
  writer.floats(network.optimiser.second);
}

LearningNetwork read_network(sct::RecordReader& reader) {
  LearningNetwork network;
  network.parameters = reader.floats();
  network.target = reader.floats();
  network.optimiser.steps = reader.steps();
  network.optimiser.first = reader.floats();
  network.optimiser.second = reader.floats();
  return network;
}

void put_evaluation(sct::RecordWriter& writer, const OnlineEvaluation& evaluation) {
  writer.word(evaluation.episodes);
  writer.word(evaluation.updates);
  for (const double number :
       {evaluation.predators, evaluation.error, evaluation.prey, evaluation.critic_loss, evaluation.value})
    writer.real(number);
  writer.word(evaluation.actors.size());
  for (const auto& actor : evaluation.actors) writer.floats(actor);
}

OnlineEvaluation read_evaluation(sct::RecordReader& reader) {
  OnlineEvaluation evaluation;
  evaluation.episodes = reader.steps();
  evaluation.updates = reader.steps();
  for (double* number :
       {&evaluation.predators, &evaluation.error, &evaluation.prey, &evaluation.critic_loss, &evaluation.value})
    *number = reader.real();
  const auto actors = reader.count(8);
  for (std::size_t i = 0; i < actors; ++i) evaluation.actors.push_back(reader.floats());
  return evaluation;
}

}  // namespace

std::string description(const OnlineTraining& training, std::string_view prey) {
  const auto& s = training.settings();
  const auto& rewards = training.scenario().rewards;
  std::string text = fmt::format(
      "scenario = {}\nreward-rule = {}\nalgorithm = {}\ncritic = {}\nprey = {}\nhidden = {}\nlearning-rate = {}\n"
      "final-learning-rate = {}\ndiscount = {}\nbatch = {}\nmemory = {}\nfirst-update = {}\nupdate-every = {}\n"
      "averaging = {}\nclip = {}\naction-penalty = {}\nexploration = {}\nfinal-exploration = {}\ntarget-noise = {}\n"
      "target-noise-clip = {}\nevaluate-every = {}\nevaluation-episodes = {}\nevaluation-seed = {}\nseed = {}\n",
      training.scenario().name, to_string(rewards.rule), to_string(s.algorithm), to_string(s.critic),
      s.prey_learns ? "learn" : prey, s.hidden, s.learning_rate, s.final_learning_rate, s.discount, s.batch, s.memory,
      s.first_update, s.update_every, s.averaging, s.clip, s.action_penalty, s.exploration, s.final_exploration,
      s.target_noise, s.target_noise_clip, s.evaluate_every, s.evaluation_episodes, s.evaluation_seed, s.seed);
  if (s.learning_rate != s.final_learning_rate || s.exploration != s.final_exploration)
    text += fmt::format("episodes = {}\n", s.episodes);
  return text;
}

std::string online_checkpoint(const OnlineTraining& training, const std::string& description) {
  const OnlineState state = training.state();
  sct::RecordWriter writer(kind, state.actions.empty() ? 0 : state.actions.size() * (state.actions[0].size() * 4 + 8));
  writer.text(description);
  writer.word(state.rounds);
  writer.word(state.updates);
  writer.word(state.agents.size());
  for (const auto& agent : state.agents) {
    put_network(writer, agent.actor);
    writer.word(agent.critics.size());
    for (const auto& critic : agent.critics) put_network(writer, critic);
  }
  writer.real(state.critic_losses);
  writer.real(state.values);
  writer.word(state.loss_updates);
  writer.word(state.value_updates);
  writer.word(state.history.size());
  for (const auto& evaluation : state.history) put_evaluation(writer, evaluation);
  writer.word(state.actions.size());
  for (const auto& actions : state.actions) writer.floats(actions);
  return std::move(writer).sealed();
}

void restore(OnlineTraining& training, std::string_view bytes, const std::string& source,
             const std::string& description) {
  sct::RecordReader reader(bytes, source, kind);
  if (const auto difference = sct::difference_of_runs(reader.text(), description); !difference.empty())
    throw UsageError(
        fmt::format("the checkpoint is of another run: {}; give that run's settings or start anew", difference));
  OnlineState state;
  state.rounds = reader.steps();
  state.updates = reader.steps();
  const auto agents = reader.count(8);
  for (std::size_t i = 0; i < agents; ++i) {
    LearningAgent agent;
    agent.actor = read_network(reader);
    const auto critics = reader.count(8);
    for (std::size_t k = 0; k < critics; ++k) agent.critics.push_back(read_network(reader));
    state.agents.push_back(std::move(agent));
  }
  state.critic_losses = reader.real();
  state.values = reader.real();
  state.loss_updates = reader.steps();
  state.value_updates = reader.steps();
  const auto evaluations = reader.count(8);
  for (std::size_t i = 0; i < evaluations; ++i) state.history.push_back(read_evaluation(reader));
  const auto rounds = reader.count(8);
  for (std::size_t i = 0; i < rounds; ++i) {
    state.actions.push_back(reader.floats());
    for (const float action : state.actions.back())
      if (!(action >= -1 && action <= 1)) reader.wrong("an action beyond [-1, 1]");
  }
  if (!reader.done()) reader.wrong("bytes too many at its end");
  training.restore(std::move(state));
}

}  // namespace folk::mpe
