// The module folk._folk: what the package folk is made of.

#include <folk/python/bindings/parts.h>

#include <folk/tools/program/data_folder.h>

#include <string>

PYBIND11_MODULE(_folk, module) {
  using namespace folk::python;
  module.doc() = "The C++ library of Folk; import folk instead.";
  module.attr("__version__") = FOLK_VERSION;
  module.def(
      "use_data_folder", [](const std::string& folder) { folk::tools::use_data_folder(folder); },
      "Shipped policies and players are read from this folder, unless the environment's FOLK_DATA names another.",
      py::arg("folder"));
  add_errors(module);
  add_games(module);
  add_strategies(module);
  add_players(module);
  add_match(module);
  add_tournament(module);
  add_thresholds(module);
  add_check(module);
  add_replies(module);
  add_region(module);
  add_classes(module);
  add_evolution(module);
  add_sct(module);
  add_mpe(module);
}
