// Scores against complete classes: what ipd-tournament --class computes.

#include <folk/python/bindings/call.h>
#include <folk/python/bindings/long_call.h>
#include <folk/python/bindings/parts.h>
#include <folk/python/bindings/text.h>

#include <folk/games/error.h>
#include <folk/strategies/standard/memory_class.h>
#include <folk/tools/ipd_tournament/classes.h>

#include <string>

namespace folk::python {
namespace {

std::string class_scores(const py::dict& options, const py::dict& guests, const py::object& progress) {
  const Call call(options, guests);
  const auto question = without_gil([&] { return tools::class_question(call.values(), call.common()); });
  const auto scores = LongCall("scoring against " + question.members.name(), progress).run([&](const Progress& told) {
    return tools::scored(question, told);
  });
  return written([&](std::ostream& out) { tools::write_scores_json(out, scores, {question.game.title}); });
}

}  // namespace

void add_classes(py::module_& module) {
  module.def("class_scores", class_scores, "What ipd-tournament --class prints, as JSON.", py::arg("options"),
             py::arg("guests"), py::arg("progress"));
  module.def(
      "class_size",
      [](const std::string& name) {
        const auto members = MemoryClass::parse(name);
        if (!members) throw UsageError(name + ": expected a complete class, memory(X,Y)");
        return members->size().str();
      },
      "How many members a complete class has, as a text.", py::arg("name"));
}

}  // namespace folk::python
