// Equilibrium checks: what sce-check asks, finds and writes.

#include <folk/python/bindings/call.h>
#include <folk/python/bindings/long_call.h>
#include <folk/python/bindings/parts.h>
#include <folk/python/bindings/text.h>
#include <folk/python/bindings/thresholds.h>

#include <folk/tools/sce_check/output.h>

#include <memory>
#include <string>
#include <utility>

namespace folk::python {
namespace {

struct HeldCheck {
  tools::SceQuestion question;
  tools::SceReport report;
};

using CheckPtr = std::shared_ptr<HeldCheck>;

CheckPtr checked(const py::dict& options, const py::dict& guests, const py::object& progress) {
  const Call call(options, guests);
  auto held = without_gil([&] {
    return std::make_shared<HeldCheck>(HeldCheck{tools::sce_question(call.values(), call.common()), {}});
  });
  // Stages of unknown length come one after the other: each is told from 0 to 1.
  held->report = LongCall("examining", progress).run([&](const Progress& told) {
    return tools::examine(held->question, [&](const std::string&) { return told; });
  });
  return held;
}

/// What the program prints in this form: "text", "csv" or "json".
std::string check_form(const CheckPtr& held, const std::string& form) {
  return written([&](std::ostream& out) {
    if (form == "text") tools::write_text(out, held->question, held->report);
    if (form == "csv") tools::write_csv(out, held->question, held->report);
    if (form == "json") tools::write_json(out, held->question, held->report, false);
  });
}

/// Of each opponent, or None where there are none.
py::list thresholds_of(const CheckPtr& held) {
  py::list all;
  for (const auto& one : held->report.opponents)
    all.append(one.thresholds ? py::object(sets_of(*one.thresholds)) : py::none());
  return all;
}

}  // namespace

void add_check(py::module_& module) {
  py::class_<HeldCheck, CheckPtr>(module, "HeldCheck", "An examination; folk.Check shows it.")
      .def("form", check_form, "What sce-check prints: text, csv, json.", py::arg("name"))
      .def(
          "html",
          [](const CheckPtr& held) {
            const py::gil_scoped_release released;
            return tools::html_page(held->question, held->report);
          },
          "The page of sce-check --output.")
      .def(
          "holds",
          [](const CheckPtr& held, const std::string& required) { return tools::holds(held->report, required); },
          "False where what sce-check --require names is refuted.", py::arg("required"))
      .def_property_readonly("thresholds", thresholds_of, "Of each opponent the sets of discount factors, by notion.");
  module.def("check", checked, "Answers what the options of sce-check ask.", py::arg("options"), py::arg("guests"),
             py::arg("progress"));
}

}  // namespace folk::python
