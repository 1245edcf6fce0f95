// Payoff regions: what payoff-region computes and writes.

#include <folk/python/bindings/call.h>
#include <folk/python/bindings/long_call.h>
#include <folk/python/bindings/parts.h>
#include <folk/python/bindings/text.h>

#include <folk/tools/payoff_region/output.h>
#include <folk/tools/payoff_region/question.h>

#include <memory>
#include <string>

namespace folk::python {
namespace {

using RegionPtr = std::shared_ptr<tools::RegionReport>;

RegionPtr found_region(const py::dict& options, const py::dict& guests, const py::object& progress) {
  const Call call(options, guests);
  return std::make_shared<tools::RegionReport>(
      LongCall("computing the region", progress).run([&](const Progress& told) {
        return tools::region_report(call.values(), call.common(), told);
      }));
}

std::string region_form(const RegionPtr& report, const std::string& form) {
  return written([&](std::ostream& out) {
    if (form == "text") tools::write_text(out, *report);
    if (form == "csv") tools::write_csv(out, *report);
    if (form == "json") tools::write_json(out, *report);
  });
}

}  // namespace

void add_region(py::module_& module) {
  py::class_<tools::RegionReport, RegionPtr>(module, "HeldRegion", "A payoff region; folk.PayoffRegion shows it.")
      .def("form", region_form, "What payoff-region prints: text, csv, json.", py::arg("name"))
      .def(
          "draw",
          [](const RegionPtr& report, const std::string& path) {
            const py::gil_scoped_release released;
            tools::draw_picture(path, *report);
          },
          "The picture of payoff-region --output.", py::arg("path"));
  module.def("payoff_region", found_region, "Answers what the options of payoff-region ask.", py::arg("options"),
             py::arg("guests"), py::arg("progress"));
}

}  // namespace folk::python
