// Best replies: what ipd-strategies reply finds.

#include <folk/python/bindings/call.h>
#include <folk/python/bindings/long_call.h>
#include <folk/python/bindings/parts.h>

#include <folk/tools/choices/game_option.h>
#include <folk/tools/ipd_strategies/reply.h>

#include <string>

namespace folk::python {
namespace {

std::string found_reply(const std::string& opponents, const py::dict& options, const py::dict& guests,
                        const py::object& progress) {
  const Call call(options, guests);
  const Payoffs payoffs = tools::chosen_game(call.values()).payoffs;
  return LongCall("searching", progress).run([&](const Progress& told) {
    return tools::reply_json(opponents, payoffs, call.values(), call.common(), told).dump();
  });
}

}  // namespace

void add_replies(py::module_& module) {
  module.def("best_reply", found_reply, "What ipd-strategies reply finds, as JSON.", py::arg("opponents"),
             py::arg("options"), py::arg("guests"), py::arg("progress"));
}

}  // namespace folk::python
