#include <folk/games/error.h>
#include <folk/sct/files/record_bytes.h>
#include <folk/sct/training/checkpoint.h>

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace folk::sct {
namespace {

constexpr RecordKind kind{"FOLKCKPT", 1, "sct-train"};
constexpr std::size_t word_bytes = 8;

// ---- writing -----------------------------------------------------------------------------------------------------

void put_lesson(RecordWriter& writer, const Lesson& lesson) {
  writer.word(lesson.rounds());
  for (const auto* numbers : {&lesson.observations, &lesson.opponent, &lesson.own, &lesson.wanted})
    writer.digits(*numbers);
  writer.floats(lesson.weights);
  writer.floats(lesson.returns);
}

void put_evaluation(RecordWriter& writer, const Evaluation& evaluation) {
  writer.word(evaluation.steps);
  writer.real(evaluation.belief_loss);
  writer.real(evaluation.action_loss);
  writer.word(evaluation.scores.size());
  for (const auto& score : evaluation.scores) {
    writer.real(score.target);
    writer.real(score.total);
    writer.real(score.accuracy.value_or(-1));
  }
}

bool holds_out(const Evaluation& evaluation) {
  return std::any_of(evaluation.scores.begin(), evaluation.scores.end(),
                     [](const TargetScore& score) { return score.held_out.has_value(); });
}

/// The last section, which is there with a held-out roster alone: a run without one is the file that it always was.
void put_held_out(RecordWriter& writer, const std::vector<Evaluation>& history) {
  if (!std::any_of(history.begin(), history.end(), holds_out)) return;
  for (const auto& evaluation : history)
    for (const auto& score : evaluation.scores) {
      const auto held_out = score.held_out.value_or(HeldOutScore{});
      writer.real(held_out.total);
      writer.real(held_out.accuracy.value_or(-1));
    }
}

// ---- reading -----------------------------------------------------------------------------------------------------

Lesson read_lesson(RecordReader& reader) {
  Lesson lesson;
  const auto rounds = reader.count(4 + 2 * sizeof(float));
  if (rounds == 0) reader.wrong("a lesson without rounds");
  lesson.observations = reader.digits(rounds, observation_size);
  lesson.opponent = reader.digits(rounds, 2);
  lesson.own = reader.digits(rounds, 2);
  lesson.wanted = reader.digits(rounds, 2);
  lesson.weights = reader.floats();
  lesson.returns = reader.floats();
  if (lesson.weights.size() != rounds || lesson.returns.size() != rounds) reader.wrong("a lesson of two lengths");
  return lesson;
}

std::optional<double> read_accuracy(RecordReader& reader) {
  const double accuracy = reader.real();
  if (accuracy > 1) reader.wrong("an accuracy beyond 1");
  return accuracy >= 0 ? std::optional(accuracy) : std::nullopt;
}

Evaluation read_evaluation(RecordReader& reader) {
  Evaluation evaluation;
  evaluation.steps = reader.steps();
  evaluation.belief_loss = reader.real();
  evaluation.action_loss = reader.real();
  const auto scores = reader.count(3 * word_bytes);
  if (scores == 0) reader.wrong("an evaluation without scores");
  for (std::size_t i = 0; i < scores; ++i) {
    TargetScore score{reader.real(), reader.real(), std::nullopt};
    score.accuracy = read_accuracy(reader);
    evaluation.scores.push_back(score);
  }
  return evaluation;
}

/// Everything between the version and the checksum.
Checkpoint read_sections(RecordReader& reader) {
  Checkpoint checkpoint;
  checkpoint.run = reader.text();
  auto& training = checkpoint.training;
  training.optimiser.steps = reader.steps();
  training.parameters = reader.floats();
  training.average = reader.floats();
  training.optimiser.first = reader.floats();
  training.optimiser.second = reader.floats();
  checkpoint.losses.steps = reader.steps();
  checkpoint.losses.belief = reader.real();
  checkpoint.losses.action = reader.real();
  const auto lessons = reader.count(3 * word_bytes);
  for (std::size_t i = 0; i < lessons; ++i) checkpoint.added.push_back(read_lesson(reader));
  const auto evaluations = reader.count(4 * word_bytes);
  for (std::size_t i = 0; i < evaluations; ++i) checkpoint.history.push_back(read_evaluation(reader));
  checkpoint.kept = reader.below(std::max<std::uint64_t>(1, evaluations), "as the index of the policy that is kept");
  checkpoint.kept_parameters = reader.floats();
  if (checkpoint.kept_parameters.size() != (evaluations == 0 ? 0 : training.parameters.size()))
    reader.wrong("a kept policy of another size");
  std::uint64_t before = 0;
  for (const auto& evaluation : checkpoint.history) {
    if (evaluation.steps <= before || evaluation.steps > training.optimiser.steps)
      reader.wrong(fmt::format("an evaluation at step {} out of order", evaluation.steps));
    before = evaluation.steps;
  }
  if (!reader.done())
    for (auto& evaluation : checkpoint.history)
      for (auto& score : evaluation.scores) {
        score.held_out = {reader.real(), std::nullopt};
        score.held_out->accuracy = read_accuracy(reader);
      }
  if (!reader.done()) reader.wrong("bytes too many at its end");
  return checkpoint;
}

std::string_view next_line(std::string_view& text) {
  const auto end = std::min(text.find('\n'), text.size());
  const auto line = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return line;
}

}  // namespace

void LossSums::add(const Losses& losses) {
  belief += losses.belief;
  action += losses.action;
  ++steps;
}

std::string checkpoint_bytes(const Checkpoint& checkpoint) {
  const auto& training = checkpoint.training;
  RecordWriter writer(kind, training.parameters.size() * 5 * sizeof(float) + checkpoint.added.size() * 2048);
  writer.text(checkpoint.run);
  writer.word(training.optimiser.steps);
  for (const auto* numbers :
       {&training.parameters, &training.average, &training.optimiser.first, &training.optimiser.second})
    writer.floats(*numbers);
  writer.word(checkpoint.losses.steps);
  writer.real(checkpoint.losses.belief);
  writer.real(checkpoint.losses.action);
  writer.word(checkpoint.added.size());
  for (const auto& lesson : checkpoint.added) put_lesson(writer, lesson);
  writer.word(checkpoint.history.size());
  for (const auto& evaluation : checkpoint.history) put_evaluation(writer, evaluation);
  writer.word(checkpoint.kept);
  writer.floats(checkpoint.kept_parameters);
  put_held_out(writer, checkpoint.history);
  return std::move(writer).sealed();
}

Checkpoint parse_checkpoint(std::string_view bytes, const std::string& source) {
  RecordReader reader(bytes, source, kind);
  return read_sections(reader);
}

std::string difference_of_runs(std::string_view there, std::string_view here) {
  const auto value = [](std::string_view line) {
    const auto sign = line.find(" = ");
    return sign == std::string_view::npos ? line : line.substr(sign + 3);
  };
  while (!there.empty() || !here.empty()) {
    const auto its = next_line(there);
    const auto ours = next_line(here);
    if (its == ours) continue;
    const auto key = (ours.empty() ? its : ours).substr(0, (ours.empty() ? its : ours).find(" = "));
    return fmt::format("{} = {} there, {} here", excerpt(key), its.empty() ? "none" : excerpt(value(its), 60),
                       ours.empty() ? "none" : excerpt(value(ours), 60));
  }
  return {};
}

}  // namespace folk::sct
