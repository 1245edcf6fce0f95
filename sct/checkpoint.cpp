#include <folk/analysis/signature.h>
#include <folk/games/error.h>
#include <folk/sct/checkpoint.h>
#include <folk/sct/little_endian.h>

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace folk::sct {
namespace {

constexpr std::string_view magic = "FOLKCKPT";
constexpr std::uint64_t version = 1;
constexpr std::size_t word_bytes = 8;
constexpr std::size_t longest_run = 1 << 16;  // bytes of its text
constexpr std::uint64_t most_steps = std::uint64_t{1} << 53U;

std::uint64_t checksum(std::string_view bytes) {
  Signature signature;
  std::size_t at = 0;
  for (; at + word_bytes <= bytes.size(); at += word_bytes)
    signature.add(load_little_endian<std::uint64_t>(bytes.substr(at)));
  signature.add(bytes.substr(at));
  return signature.value();
}

// ---- writing -----------------------------------------------------------------------------------------------------

void put_word(std::string& bytes, std::uint64_t word) { append_little_endian(bytes, word); }

void require_finite(double number) {
  if (!std::isfinite(number))
    throw UsageError("training has diverged, its numbers are not finite: lower learning-rate or clip");
}

void put_real(std::string& bytes, double number) {
  require_finite(number);
  put_word(bytes, std::bit_cast<std::uint64_t>(number));
}

void put_floats(std::string& bytes, const std::vector<float>& numbers) {
  put_word(bytes, numbers.size());
  for (const float number : numbers) {
    require_finite(static_cast<double>(number));
    append_little_endian(bytes, std::bit_cast<std::uint32_t>(number));
  }
}

void put_lesson(std::string& bytes, const Lesson& lesson) {
  put_word(bytes, lesson.rounds());
  for (const auto* numbers : {&lesson.observations, &lesson.opponent, &lesson.own, &lesson.wanted})
    bytes.append(numbers->begin(), numbers->end());
  put_floats(bytes, lesson.weights);
  put_floats(bytes, lesson.returns);
}

void put_evaluation(std::string& bytes, const Evaluation& evaluation) {
  put_word(bytes, evaluation.steps);
  put_real(bytes, evaluation.belief_loss);
  put_real(bytes, evaluation.action_loss);
  put_word(bytes, evaluation.scores.size());
  for (const auto& score : evaluation.scores) {
    put_real(bytes, score.target);
    put_real(bytes, score.total);
    put_real(bytes, score.accuracy.value_or(-1));
  }
}

// ---- reading -----------------------------------------------------------------------------------------------------

/// Takes a file apart from its front; every length is held against what is left.
class Reader {
public:
  Reader(std::string_view bytes, const std::string& source)
      : bytes_(bytes),
        source_(source) {}

  [[noreturn]] void refuse(const std::string& what) const {
    throw InputFileError(fmt::format("{}: {}", excerpt(source_, 1000), what));
  }

  std::string_view take(std::size_t size) {
    if (size > bytes_.size()) refuse("damaged checkpoint: ends too soon; remove it and resume from the one before");
    const auto taken = bytes_.substr(0, size);
    bytes_.remove_prefix(size);
    return taken;
  }

  std::uint64_t word() { return load_little_endian<std::uint64_t>(take(word_bytes)); }

  std::uint64_t steps() { return below(most_steps, "steps"); }

  std::uint64_t below(std::uint64_t bound, const char* what) {
    const auto number = word();
    if (number >= bound) wrong(fmt::format("{} {}", number, what));
    return number;
  }

  /// How many elements follow, each of at least `element_bytes`.
  std::size_t count(std::size_t element_bytes) {
    const auto elements = word();
    if (elements > bytes_.size() / element_bytes) wrong(fmt::format("a list of {} elements", elements));
    return static_cast<std::size_t>(elements);
  }

  double real() {
    const auto number = std::bit_cast<double>(word());
    if (!std::isfinite(number)) wrong("a number that is not finite");
    return number;
  }

  std::vector<float> floats() {
    std::vector<float> numbers(count(sizeof(float)));
    for (float& number : numbers) {
      number = std::bit_cast<float>(load_little_endian<std::uint32_t>(take(sizeof(float))));
      if (!std::isfinite(number)) wrong("a number that is not finite");
    }
    return numbers;
  }

  std::vector<std::uint8_t> digits(std::size_t size, unsigned bound) {
    const auto taken = take(size);
    std::vector<std::uint8_t> numbers(taken.begin(), taken.end());
    if (std::any_of(numbers.begin(), numbers.end(), [&](std::uint8_t number) { return number >= bound; }))
      wrong("a lesson with an impossible move");
    return numbers;
  }

  std::string text() {
    const auto size = count(1);
    if (size > longest_run) wrong("settings that are too long");
    return std::string(take(size));
  }

  bool done() const { return bytes_.empty(); }

  [[noreturn]] void wrong(const std::string& what) const {
    refuse(fmt::format("damaged checkpoint: {}; remove it and resume from the one before", what));
  }

private:
  std::string_view bytes_;
  const std::string& source_;
};

Lesson read_lesson(Reader& reader) {
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

Evaluation read_evaluation(Reader& reader) {
  Evaluation evaluation;
  evaluation.steps = reader.steps();
  evaluation.belief_loss = reader.real();
  evaluation.action_loss = reader.real();
  const auto scores = reader.count(3 * word_bytes);
  if (scores == 0) reader.wrong("an evaluation without scores");
  for (std::size_t i = 0; i < scores; ++i) {
    TargetScore score{reader.real(), reader.real(), std::nullopt};
    const double accuracy = reader.real();
    if (accuracy > 1) reader.wrong("an accuracy beyond 1");
    if (accuracy >= 0) score.accuracy = accuracy;
    evaluation.scores.push_back(score);
  }
  return evaluation;
}

/// Everything between the version and the checksum.
Checkpoint read_sections(Reader& reader) {
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
  std::string bytes(magic);
  bytes.reserve(training.parameters.size() * 5 * sizeof(float) + checkpoint.added.size() * 2048);
  put_word(bytes, version);
  put_word(bytes, checkpoint.run.size());
  bytes += checkpoint.run;
  put_word(bytes, training.optimiser.steps);
  for (const auto* numbers :
       {&training.parameters, &training.average, &training.optimiser.first, &training.optimiser.second})
    put_floats(bytes, *numbers);
  put_word(bytes, checkpoint.losses.steps);
  put_real(bytes, checkpoint.losses.belief);
  put_real(bytes, checkpoint.losses.action);
  put_word(bytes, checkpoint.added.size());
  for (const auto& lesson : checkpoint.added) put_lesson(bytes, lesson);
  put_word(bytes, checkpoint.history.size());
  for (const auto& evaluation : checkpoint.history) put_evaluation(bytes, evaluation);
  put_word(bytes, checkpoint.kept);
  put_floats(bytes, checkpoint.kept_parameters);
  put_word(bytes, checksum(bytes));
  return bytes;
}

Checkpoint parse_checkpoint(std::string_view bytes, const std::string& source) {
  Reader reader(bytes, source);
  if (!bytes.starts_with(magic) || bytes.size() < magic.size() + 2 * word_bytes)
    reader.refuse("no checkpoint of sct-train, or only its beginning; remove it");
  const auto found = load_little_endian<std::uint64_t>(bytes.substr(magic.size()));
  if (found != version)
    reader.refuse(
        fmt::format("a checkpoint of version {}, but this Folk reads {}; use the Folk that wrote it", found, version));
  const auto end = bytes.size() - word_bytes;
  if (load_little_endian<std::uint64_t>(bytes.substr(end)) != checksum(bytes.substr(0, end)))
    reader.wrong("its checksum is another");
  Reader sections(bytes.substr(magic.size() + word_bytes, end - magic.size() - word_bytes), source);
  return read_sections(sections);
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
