// What becomes of populations: what ipd-evolve computes and writes.

#include <folk/python/bindings/array.h>
#include <folk/python/bindings/call.h>
#include <folk/python/bindings/long_call.h>
#include <folk/python/bindings/parts.h>
#include <folk/python/bindings/text.h>

#include <folk/games/error.h>
#include <folk/tools/choices/whole_class.h>
#include <folk/tools/ipd_evolve/evolution_output.h>
#include <folk/tools/ipd_evolve/fixation_output.h>
#include <folk/tools/ipd_evolve/pictures.h>
#include <folk/tools/ipd_evolve/question.h>
#include <folk/tools/ipd_evolve/scores.h>
#include <folk/tools/ipd_evolve/solved.h>
#include <folk/tools/program/threads_option.h>

#include <pybind11/stl.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace folk::python {
namespace {

/// The question and the answer, of which there is one.
struct HeldEvolution {
  tools::PlayedScores played;
  tools::EvolveQuestion question;
  std::uint64_t seed = 1;
  unsigned threads = 1;
  std::optional<Evolution> evolution{};
  FixationCounts counts{};
  std::optional<tools::FixationReport> solved{};

  tools::EvolutionReport report() const { return {played, question, *evolution, {}}; }

  void answer(const Progress& progress) {
    switch (question.question) {
      case tools::Question::evolution:
        evolution.emplace(question.dynamics, question.start, seed);
        evolution->run(question.generations, progress);
        break;
      case tools::Question::runs:
        simulate_fixation(counts, *question.dynamics, question.start, question.runs, question.generations, seed,
                          threads, progress);
        break;
      case tools::Question::fixation:
      case tools::Question::stationary: solved.emplace(tools::solved(played, question, seed, threads, progress)); break;
    }
  }
};

using EvolutionPtr = std::shared_ptr<HeldEvolution>;

EvolutionPtr evolved(const py::dict& options, const py::dict& guests, const py::object& progress) {
  const Call call(options, guests);
  const auto& values = call.values();
  tools::check_question(values);
  if (tools::unlisted_class(tools::text_option(values, "strategies")))
    throw UsageError("a class of that size is evolved by ipd-evolve alone: take a smaller one, or sample(SPEC;N)");
  const auto held = std::make_shared<HeldEvolution>();
  held->seed = tools::whole_option(values, "seed", 1, 0, ~std::uint64_t{0});
  held->threads = tools::threads_option(values, call.common());
  LongCall("evolving", progress).run([&](const Progress& told) {
    held->played = tools::chosen_scores(values, call.common(), held->seed, held->threads, told.part(0, 0.5));
    held->question = tools::chosen_question(values, held->played.scores);
    held->answer(told.part(0.5, 1));
  });
  return held;
}

std::string evolution_form(const EvolutionPtr& held, const std::string& form) {
  const auto format = form == "text" ? tools::Format::text : form == "csv" ? tools::Format::csv : tools::Format::json;
  return written([&](std::ostream& out) {
    if (held->solved) return tools::write_fixation(out, *held->solved, format);
    if (!held->evolution)
      return tools::write_runs(out, {held->played, held->question, held->counts, held->seed, {}}, format);
    switch (format) {
      case tools::Format::text: return tools::write_evolution_text(out, held->report());
      case tools::Format::csv: return tools::write_evolution_csv(out, held->report());
      case tools::Format::json: return tools::write_evolution_json(out, held->report(), false);
    }
  });
}

void draw_held_evolution(const EvolutionPtr& held, const std::string& folder, const std::string& extension) {
  const py::gil_scoped_release released;
  if (held->solved) {
    tools::require_fixation_picture(held->played.scores->size());
    tools::draw_fixation(folder, *held->solved, extension);
  } else if (held->evolution) {
    tools::draw_evolution(folder, held->report(), extension);
  } else {
    throw UsageError("there is no picture of who took over in runs");
  }
}

/// Generations that were kept, and the populations in them, a row a generation.
py::tuple history_of(const EvolutionPtr& held) {
  std::vector<std::uint64_t> generations;
  std::vector<double> numbers;
  if (held->evolution)
    for (const auto& row : held->evolution->state().history.rows()) {
      generations.push_back(row.generation);
      numbers.insert(numbers.end(), row.population.begin(), row.population.end());
    }
  const auto rows = static_cast<py::ssize_t>(generations.size());
  const auto columns = static_cast<py::ssize_t>(held->played.scores->size());
  return py::make_tuple(array_of(std::move(generations)), array_of(std::move(numbers), {rows, columns}));
}

}  // namespace

void add_evolution(py::module_& module) {
  py::class_<HeldEvolution, EvolutionPtr>(module, "HeldEvolution", "An evolution; folk.Evolution shows it.")
      .def("form", evolution_form, "What ipd-evolve prints: text, csv, json.", py::arg("name"))
      .def_property_readonly(
          "names", [](const EvolutionPtr& held) { return held->played.scores->names(); }, "The strategies, in order.")
      .def("draw", draw_held_evolution, "The pictures of --plot, into a folder.", py::arg("folder"),
           py::arg("extension"))
      .def("history", history_of, "Generations that were kept and their populations, (K,) and (K, N).");
  module.def("evolve", evolved, "Answers what the options of ipd-evolve ask.", py::arg("options"), py::arg("guests"),
             py::arg("progress"));
}

}  // namespace folk::python
