#include <folk/games/error.h>
#include <folk/mpe/data/data_figures.h>
#include <folk/mpe/offline/bc.h>
#include <folk/mpe/offline/learners.h>
#include <folk/mpe/offline/ma_bcq.h>
#include <folk/mpe/offline/omar.h>
#include <folk/mpe/offline/transformer.h>
#include <folk/strategies/registry.h>

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace folk::mpe {
namespace {

/// Throws UsageError where neither the choice nor the data say it.
std::string level_of(const DataSet& data, const LearnerChoice& choice) {
  if (choice.level) return *choice.level;
  const auto& record = data.record();
  if (record && !record->description.level.empty()) return record->description.level;
  throw UsageError(fmt::format("{}: the data do not say their level, by which {}'s numbers are chosen; give --level",
                               excerpt(data.source(), 1000), to_string(choice.kind)));
}

/// The settings that a choice names, taken one after the other: what is left at the end was not this learner's.
class Choices {
public:
  explicit Choices(const LearnerChoice& choice)
      : choice_(choice) {}

  template <class T, class U>
  void take(std::optional<T> LearnerChoice::*place, const char* name, U& setting) {
    if (choice_.*place) setting = static_cast<U>(*(choice_.*place));
    taken_.push_back(name);
  }

  void require_nothing_left() const {
    const auto refuse = [&](const char* name, bool given) {
      if (given && std::find(taken_.begin(), taken_.end(), std::string_view(name)) == taken_.end())
        throw UsageError(fmt::format("{}: {} has no such setting; leave it out", name, to_string(choice_.kind)));
    };
    refuse("hidden", choice_.hidden.has_value());
    refuse("layers", choice_.layers.has_value());
    refuse("batch", choice_.batch.has_value());
    refuse("learning-rate", choice_.learning_rate.has_value());
    refuse("dropout", choice_.dropout.has_value());
    refuse("loss", choice_.loss.has_value());
    refuse("readout", choice_.readout.has_value());
    refuse("conservatism", choice_.conservatism.has_value());
    refuse("imitation", choice_.imitation.has_value());
  }

private:
  const LearnerChoice& choice_;
  std::vector<std::string_view> taken_;
};

TransformerSettings transformer_settings(const DataSet& data, const LearnerChoice& choice) {
  TransformerSettings settings;
  if (choice.budget != Budget::paper) {
    settings.hidden = choice.budget == Budget::smoke ? 16 : 64;
    settings.layers = choice.budget == Budget::smoke ? 1 : 2;
    settings.optimiser.learning_rate = 2e-3;
    settings.optimiser.warmup_steps = 200;
    settings.optimiser.decay_steps = learner_steps(data, choice);
  }
  Choices choices(choice);
  choices.take(&LearnerChoice::hidden, "hidden", settings.hidden);
  choices.take(&LearnerChoice::layers, "layers", settings.layers);
  choices.take(&LearnerChoice::batch, "batch", settings.batch);
  choices.take(&LearnerChoice::learning_rate, "learning-rate", settings.optimiser.learning_rate);
  choices.take(&LearnerChoice::dropout, "dropout", settings.dropout);
  if (choice.kind == LearnerKind::sct) {
    choices.take(&LearnerChoice::loss, "loss", settings.mode);
    choices.take(&LearnerChoice::readout, "readout", settings.readout);
    if (settings.mode == sct::LossMode::action_only || settings.readout == sct::Readout::own)
      throw UsageError("sct acts on a belief: without one it is madt (no belief) or rmadt (own readout)");
  }
  choices.require_nothing_left();
  if (choice.kind == LearnerKind::madt) settings = madt(settings);
  if (choice.kind == LearnerKind::rmadt) settings = rmadt(settings);
  settings.seed = choice.seed;
  settings.threads = choice.threads;
  return settings;
}

BcSettings bc_settings(const DataSet& data, const LearnerChoice& choice) {
  BcSettings settings;
  if (choice.budget != Budget::paper) {
    settings.learning_rate = 1e-3;
    settings.warmup_steps = 200;
    settings.decay_steps = learner_steps(data, choice);
  }
  Choices choices(choice);
  choices.take(&LearnerChoice::hidden, "hidden", settings.hidden);
  choices.take(&LearnerChoice::layers, "layers", settings.layers);
  choices.take(&LearnerChoice::batch, "batch", settings.batch);
  choices.take(&LearnerChoice::learning_rate, "learning-rate", settings.learning_rate);
  choices.take(&LearnerChoice::dropout, "dropout", settings.dropout);
  choices.require_nothing_left();
  settings.seed = choice.seed;
  settings.threads = choice.threads;
  return settings;
}

MaBcqSettings ma_bcq_settings(const LearnerChoice& choice) {
  MaBcqSettings settings;
  if (choice.budget == Budget::small) settings.vae_hidden = 128;
  if (choice.budget == Budget::smoke) {
    settings.vae_hidden = 16;
    settings.hidden = {16, 16};
    settings.acting_candidates = 10;
  }
  Choices choices(choice);
  choices.take(&LearnerChoice::hidden, "hidden", settings.vae_hidden);
  choices.take(&LearnerChoice::batch, "batch", settings.batch);
  choices.take(&LearnerChoice::learning_rate, "learning-rate", settings.learning_rate);
  choices.require_nothing_left();
  settings.seed = choice.seed;
  settings.threads = choice.threads;
  return settings;
}

OmarSettings omar_settings(const DataSet& data, const LearnerChoice& choice) {
  OmarSettings settings =
      OmarSettings::published(data.scenario().name, level_of(data, choice), choice.kind == LearnerKind::cql);
  Choices choices(choice);
  choices.take(&LearnerChoice::hidden, "hidden", settings.hidden);
  choices.take(&LearnerChoice::batch, "batch", settings.batch);
  choices.take(&LearnerChoice::learning_rate, "learning-rate", settings.learning_rate);
  choices.take(&LearnerChoice::conservatism, "conservatism", settings.conservatism);
  if (choice.kind == LearnerKind::omar) choices.take(&LearnerChoice::imitation, "imitation", settings.imitation);
  choices.require_nothing_left();
  settings.seed = choice.seed;
  settings.threads = choice.threads;
  return settings;
}

template <class Enum, std::size_t size>
Enum parse_word(std::string_view text, const std::array<Enum, size>& all, const char* what) {
  for (const Enum one : all)
    if (name_key(text) == name_key(to_string(one))) return one;
  std::string known;
  for (const Enum one : all) known += fmt::format("{}{}", known.empty() ? "" : ", ", to_string(one));
  throw UsageError(fmt::format("'{}' is no {}: expected {}", excerpt(text), what, known));
}

}  // namespace

std::string_view to_string(LearnerKind kind) {
  switch (kind) {
    case LearnerKind::bc: return "bc";
    case LearnerKind::ma_bcq: return "ma-bcq";
    case LearnerKind::omar: return "omar";
    case LearnerKind::cql: return "cql";
    case LearnerKind::madt: return "madt";
    case LearnerKind::rmadt: return "rmadt";
    case LearnerKind::sct: return "sct";
  }
  return "?";
}

LearnerKind parse_learner(std::string_view text) { return parse_word(text, learner_kinds, "learner"); }

std::string_view to_string(Budget budget) {
  return budget == Budget::smoke ? "smoke" : budget == Budget::small ? "small" : "paper";
}

Budget parse_budget(std::string_view text) {
  return parse_word(text, std::array{Budget::smoke, Budget::small, Budget::paper}, "budget");
}

std::uint64_t learner_steps(const DataSet& data, const LearnerChoice& choice) {
  if (choice.steps) return *choice.steps;
  if (choice.budget == Budget::smoke) return 10;
  const bool small = choice.budget == Budget::small;
  switch (choice.kind) {
    case LearnerKind::bc: return small ? 10'000 : 150'000;
    case LearnerKind::ma_bcq: return small ? 3'000 : 1'000'000;  // as Fujimoto et al. trained; the paper is silent
    case LearnerKind::omar:
    case LearnerKind::cql: return published_omar_steps(data.scenario().name, level_of(data, choice));
    case LearnerKind::madt:
    case LearnerKind::rmadt:
    case LearnerKind::sct: break;
  }
  if (small) return 4'000;
  return level_of(data, choice) == "random" ? 100'000 : 10'000;
}

std::unique_ptr<OfflineLearner> make_learner(const DataSet& data, const LearnerChoice& choice) {
  switch (choice.kind) {
    case LearnerKind::bc: return std::make_unique<BcLearner>(data, bc_settings(data, choice));
    case LearnerKind::ma_bcq: return std::make_unique<MaBcqLearner>(data, ma_bcq_settings(choice));
    case LearnerKind::omar:
    case LearnerKind::cql: return std::make_unique<OmarLearner>(data, omar_settings(data, choice));
    case LearnerKind::madt:
    case LearnerKind::rmadt:
    case LearnerKind::sct: break;
  }
  return std::make_unique<TransformerLearner>(data, transformer_settings(data, choice));
}

std::string run_description(const DataSet& data, const LearnerChoice& choice, const OfflineLearner& learner) {
  return fmt::format("data = {:016x}\nscenario = {}\nlearner = {}\n{}", data_figures(data, choice.threads).signature,
                     data.scenario().name, to_string(choice.kind), learner.description());
}

}  // namespace folk::mpe
