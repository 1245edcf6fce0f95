#pragma once
// The offline learners by their names, and what each budget gives them.

#include <folk/mpe/data/data_set.h>
#include <folk/mpe/offline/offline_learner.h>
#include <folk/sct/network/architecture.h>
#include <folk/sct/policy/policy.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace folk::mpe {

enum class LearnerKind { bc, ma_bcq, omar, cql, madt, rmadt, sct };
inline constexpr std::array learner_kinds{LearnerKind::bc,   LearnerKind::ma_bcq, LearnerKind::omar, LearnerKind::cql,
                                          LearnerKind::madt, LearnerKind::rmadt,  LearnerKind::sct};

std::string_view to_string(LearnerKind kind);

/// Throws UsageError for any other word, with those that are known.
LearnerKind parse_learner(std::string_view text);

/// How much training a learner gets.
enum class Budget {
  smoke,  ///< seconds: whether it runs, nothing more
  small,  ///< minutes on one core
  paper   ///< what the sources say
};
std::string_view to_string(Budget budget);
Budget parse_budget(std::string_view text);

/// Which learner, and what of its settings is not its budget's.
struct LearnerChoice {
  LearnerKind kind = LearnerKind::sct;
  Budget budget = Budget::small;
  std::uint64_t seed = 1;
  unsigned threads = 1;
  std::optional<std::string> level;  ///< of the data, where they do not say it; OMAR's numbers are chosen by it
  std::optional<std::uint64_t> steps;
  std::optional<std::size_t> hidden, layers, batch;
  std::optional<double> learning_rate, dropout;
  std::optional<sct::LossMode> loss;              ///< of sct: teacher, selfconf or composite
  std::optional<sct::Readout> readout;            ///< of sct: token, cat or add
  std::optional<double> conservatism, imitation;  ///< of omar and cql: alpha and c
};

/// Gradient steps of a run: choice.steps, or the budget's.
std::uint64_t learner_steps(const DataSet& data, const LearnerChoice& choice);

/// `data` must outlive it. Throws UsageError, naming the setting, when this learner has no such setting or one is out
/// of range.
std::unique_ptr<OfflineLearner> make_learner(const DataSet& data, const LearnerChoice& choice);

/// All that a run depends on but the number of steps, one "key = value" a line: which data, which learner, which
/// settings.
std::string run_description(const DataSet& data, const LearnerChoice& choice, const OfflineLearner& learner);

}  // namespace folk::mpe
