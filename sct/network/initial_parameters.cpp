#include <folk/games/random.h>
#include <folk/sct/network/initial_parameters.h>

#include <cmath>
#include <string_view>

namespace folk::sct {

std::vector<float> initial_parameters(const Architecture& architecture, std::uint64_t seed) {
  const ParameterLayout layout(architecture);
  std::vector<float> parameters(layout.size());
  std::size_t inputs = 1;
  for (std::size_t i = 0; i < layout.tensors().size(); ++i) {
    const auto& tensor = layout.tensors()[i];
    const std::string_view name = tensor.name;
    const bool weight = name.ends_with(".weight");
    const bool block = name.starts_with("h.");
    const bool table =
        name == "embed_timestep.weight" ||
        (architecture.discrete && (name.starts_with("embed_opoact") || name.starts_with("embed_curact")));
    RandomStream random({seed, 0, i, 16});
    if (weight && tensor.shape.size() > 1) inputs = tensor.columns();
    const double width = 1 / std::sqrt(static_cast<double>(inputs));
    for (std::size_t k = 0; k < tensor.size(); ++k) {
      double value = 0;
      if (tensor.shape.size() == 1 && (block || name.starts_with("ln_f") || name.starts_with("embed_ln")))
        value = weight ? 1 : 0;
      else if (block)
        value = 0.02 * random.normal();
      else if (table)
        value = random.normal();
      else
        value = width * (2 * random.uniform() - 1);
      parameters[tensor.offset + k] = static_cast<float>(value);
    }
  }
  return parameters;
}

}  // namespace folk::sct
