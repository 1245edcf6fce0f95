#include <folk/python/bindings/call.h>

#include <folk/games/error.h>
#include <folk/games/stage_game.h>
#include <folk/strategies/quoted_text.h>
#include <folk/strategies/registry.h>

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <utility>
#include <vector>

namespace folk::python {
namespace {

using Guests = std::map<std::string, Strategy>;

Guests guests_of(const py::dict& given) {
  Guests guests;
  for (const auto& [name, strategy] : given) guests.emplace(name.cast<std::string>(), strategy.cast<Strategy>());
  return guests;
}

void add_guests(Registry& registry, const std::shared_ptr<const Guests>& guests) {
  if (guests->empty()) return;
  registry.add_prefix(
      {"python:NAME", {}, "an object of this program", "docs/python.md"},
      "python:", [guests](std::string_view name, const Payoffs&) {
        const auto found = guests->find(unquoted(name));
        if (found == guests->end())
          throw UsageError(fmt::format("there is no object 'python:{}' here: give the object itself", excerpt(name)));
        return std::vector<Strategy>{found->second};
      });
}

boost::any value_of(const py::handle& value) {
  if (py::isinstance<StageGame>(value)) return value.cast<StageGame>();
  if (py::isinstance<py::tuple>(value)) return value.cast<std::vector<std::string>>();
  return value.is(py::handle(Py_True)) ? std::string() : value.cast<std::string>();
}

}  // namespace

Call::Call(const py::dict& options, const py::dict& guests)
    : guests_([found = std::make_shared<const Guests>(guests_of(guests))](Registry& registry) {
        add_guests(registry, found);
      }) {
  for (const auto& [name, value] : options)
    values_.insert({name.cast<std::string>(), tools::po::variable_value(value_of(value), false)});
  common_.quiet = true;
  common_.program = "folk";
  common_.command = "import folk";
}

}  // namespace folk::python
