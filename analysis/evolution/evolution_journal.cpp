#include <folk/analysis/crew/seal.h>
#include <folk/analysis/evolution/evolution_journal.h>
#include <folk/games/error.h>

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

namespace folk {
namespace {

constexpr std::string_view evolution_title = "folk evolution journal 1";
constexpr std::string_view fixation_title = "folk fixation journal 1";

void put(fmt::memory_buffer& out, std::string_view name, const std::vector<double>& numbers) {
  fmt::format_to(std::back_inserter(out), "{}", name);
  for (const double number : numbers) fmt::format_to(std::back_inserter(out), " {}", number);
  out.push_back('\n');
}

void put(fmt::memory_buffer& out, std::string_view name, const std::vector<std::uint64_t>& numbers) {
  fmt::format_to(std::back_inserter(out), "{} {}\n", name, fmt::join(numbers, " "));
}

/// Reads the words of a sealed text one by one.
class SealedReader {
public:
  SealedReader(std::string_view text, std::string_view title, const std::string& source, std::uint64_t identity)
      : source_(source) {
    rest_ = unsealed(text, title, source_);
    word("identity");
    if (token() != fmt::format("{:016x}", identity)) refuse_other_run(source_);
  }

  void word(std::string_view expected) {
    if (token() != expected) damaged();
  }

  template <class Number>
  Number number() {
    const auto text = token();
    Number value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) damaged();
    return value;
  }

  template <class Number>
  std::vector<Number> numbers(std::string_view name, std::size_t count) {
    word(name);
    std::vector<Number> found;
    for (std::size_t i = 0; i < count; ++i) found.push_back(number<Number>());
    return found;
  }

  Population population(std::string_view name, std::size_t count) {
    word(name);
    return population_values(count);
  }

  Population population_values(std::size_t count) {
    Population found;
    for (std::size_t i = 0; i < count; ++i) {
      found.push_back(number<double>());
      if (!(found.back() >= 0 && found.back() <= most_individuals)) damaged();
    }
    return found;
  }

  void end() {
    if (!token().empty()) damaged();
  }

  [[noreturn]] void damaged() const { refuse_file(source_, "a journal that makes no sense: delete it to begin anew"); }

private:
  std::string_view token() {
    const auto begin = rest_.find_first_not_of(" \n");
    if (begin == std::string_view::npos) return {};
    const auto end = std::min(rest_.find_first_of(" \n", begin), rest_.size());
    const auto found = rest_.substr(begin, end - begin);
    rest_.remove_prefix(end);
    return found;
  }

  const std::string& source_;
  std::string_view rest_;
};

}  // namespace

std::string journal_text(const EvolutionState& state, std::uint64_t identity) {
  fmt::memory_buffer out;
  fmt::format_to(std::back_inserter(out), "{}\nidentity {:016x}\ngeneration {}\nend {} {}\nstride {} rows {}\n",
                 evolution_title, identity, state.generation, static_cast<unsigned>(state.end), state.period,
                 state.history.stride(), state.history.rows().size());
  put(out, "population", state.population);
  put(out, "extinct", state.extinct_at);
  fmt::format_to(std::back_inserter(out), "marked {}\n", state.marked_generation);
  put(out, "mark", state.marked);
  for (const auto& [generation, population] : state.history.rows())
    put(out, fmt::format("row {}", generation), population);
  fmt::format_to(std::back_inserter(out), "summaries {}\n", state.summaries.size());
  for (const auto& summary : state.summaries)
    fmt::format_to(std::back_inserter(out), "{} {} {} {} {}\n", summary.generation, summary.living, summary.individuals,
                   summary.leader, summary.number);
  return sealed(fmt::to_string(out));
}

EvolutionState read_evolution_journal(std::string_view text, const std::string& source, std::uint64_t identity,
                                      std::size_t strategies) {
  SealedReader reader(text, evolution_title, source, identity);
  EvolutionState state;
  reader.word("generation");
  state.generation = reader.number<std::uint64_t>();
  reader.word("end");
  const auto end = reader.number<unsigned>();
  if (end > static_cast<unsigned>(EvolutionEnd::uniform)) reader.damaged();
  state.end = static_cast<EvolutionEnd>(end);
  state.period = reader.number<std::uint64_t>();
  reader.word("stride");
  const auto stride = reader.number<std::uint64_t>();
  reader.word("rows");
  const auto rows = reader.number<std::uint64_t>();
  if (stride == 0 || rows == 0 || rows > PopulationHistory::most_numbers + 2) reader.damaged();
  state.population = reader.population("population", strategies);
  state.extinct_at = reader.numbers<std::uint64_t>("extinct", strategies);
  reader.word("marked");
  state.marked_generation = reader.number<std::uint64_t>();
  state.marked = reader.population("mark", strategies);
  std::vector<PopulationHistory::Row> history;
  for (std::uint64_t r = 0; r < rows; ++r) {
    reader.word("row");
    const auto generation = reader.number<std::uint64_t>();
    if (r == 0 ? generation != 0 : generation <= history.back().generation) reader.damaged();
    if (generation > state.generation) reader.damaged();
    history.push_back({generation, {}});
    history.back().population = reader.population_values(strategies);
  }
  reader.word("summaries");
  for (auto left = reader.number<std::uint64_t>(); left > 0; --left) {
    GenerationSummary summary;
    summary.generation = reader.number<std::uint64_t>();
    summary.living = reader.number<std::uint64_t>();
    summary.individuals = reader.number<double>();
    summary.leader = reader.number<std::uint64_t>();
    summary.number = reader.number<double>();
    if (summary.leader >= strategies || summary.generation > state.generation) reader.damaged();
    state.summaries.push_back(summary);
  }
  if (state.summaries.empty()) reader.damaged();  // that of the start is always there
  reader.end();
  state.history = PopulationHistory::restored(stride, std::move(history));
  return state;
}

std::string journal_text(const FixationCounts& counts, std::uint64_t identity) {
  fmt::memory_buffer out;
  fmt::format_to(std::back_inserter(out), "{}\nidentity {:016x}\nruns {}\nunsettled {}\n", fixation_title, identity,
                 counts.runs, counts.unsettled);
  put(out, "taken", counts.taken_over);
  return sealed(fmt::to_string(out));
}

FixationCounts read_fixation_journal(std::string_view text, const std::string& source, std::uint64_t identity,
                                     std::size_t strategies) {
  SealedReader reader(text, fixation_title, source, identity);
  FixationCounts counts;
  reader.word("runs");
  counts.runs = reader.number<std::uint64_t>();
  reader.word("unsettled");
  counts.unsettled = reader.number<std::uint64_t>();
  counts.taken_over = reader.numbers<std::uint64_t>("taken", strategies);
  reader.end();
  std::uint64_t left = counts.runs;
  for (const std::uint64_t count : counts.taken_over) {
    if (count > left) reader.damaged();
    left -= count;
  }
  if (left != counts.unsettled) reader.damaged();
  return counts;
}

}  // namespace folk
