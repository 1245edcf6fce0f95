// One match: what ipd-match plays and writes.

#include <folk/python/bindings/call.h>
#include <folk/python/bindings/long_call.h>
#include <folk/python/bindings/parts.h>
#include <folk/python/bindings/text.h>

#include <folk/tools/ipd_match/output.h>
#include <folk/tools/ipd_match/settings.h>

namespace folk::python {
namespace {

struct HeldMatch {
  tools::MatchSettings settings;
  tools::MatchRecord record;
};

HeldMatch played_match(const py::dict& options, const py::dict& guests, const py::object& progress) {
  const Call call(options, guests);
  HeldMatch match{tools::chosen_match(call.values()), {}};
  match.record =
      LongCall("playing", progress).run([&](const Progress& told) { return tools::play_one(match.settings, told); });
  return match;
}

/// What the program prints in this form: "text" or "json".
std::string match_form(const HeldMatch& match, const std::string& form) {
  return written([&](std::ostream& out) {
    if (form == "text") tools::write_text(out, match.settings, match.record, {});
    if (form == "json") tools::write_json(out, match.settings, match.record);
  });
}

}  // namespace

void add_match(py::module_& module) {
  py::class_<HeldMatch>(module, "HeldMatch", "A match that was played; folk.Match shows it.")
      .def("form", match_form, "What ipd-match prints: text, json.", py::arg("name"));
  module.def("match", played_match, "Plays the match that the options of ipd-match describe.", py::arg("options"),
             py::arg("guests"), py::arg("progress"));
}

}  // namespace folk::python
