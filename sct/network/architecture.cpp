#include <folk/games/error.h>
#include <folk/sct/network/architecture.h>

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace folk::sct {

std::string_view to_string(Readout readout) {
  switch (readout) {
    case Readout::token: return "token";
    case Readout::cat: return "cat";
    case Readout::add: return "add";
    case Readout::own: return "own";
  }
  return "?";
}

void Architecture::check() const {
  const auto within = [](std::size_t value, std::size_t least, std::size_t most, const char* what) {
    if (value < least || value > most)
      throw UsageError(fmt::format("{} = {}: expected {} to {}", what, value, least, most));
  };
  within(hidden, 1, 8192, "hidden");
  within(layers, 1, 256, "layers");
  within(heads, 1, hidden, "heads");
  within(context, 1, 4096, "context");
  within(time_rows, 1, 1'000'000, "time_rows");
  within(observation_size, 1, 65'536, "observation_size");
  within(action_size, discrete ? 2 : 1, 1024, "action_size");
  within(agents, 1, 64, "agents");
  if (hidden % heads != 0)
    throw UsageError(fmt::format("hidden = {} is not divided by heads = {}: give a multiple of it", hidden, heads));
  if (!belief_token && readout != Readout::own)
    throw UsageError(fmt::format("readout {} reads the belief token: it must be in the stream", to_string(readout)));
}

ParameterLayout::ParameterLayout(const Architecture& architecture) {
  architecture.check();
  const auto h = architecture.hidden;
  const auto a = architecture.action_size;
  const auto s = architecture.observation_size;
  const auto n = architecture.agents;
  const auto normalisation = [&](const std::string& name) {
    add(name + ".weight", {h});
    add(name + ".bias", {h});
  };
  const auto linear = [&](const std::string& name, std::size_t out, std::size_t in) {
    add(name + ".weight", {out, in});
    add(name + ".bias", {out});
  };
  const auto convolution = [&](const std::string& name, std::size_t in, std::size_t out) {
    add(name + ".weight", {in, out});
    add(name + ".bias", {out});
  };
  const auto action_embedding = [&](const std::string& name) {
    if (architecture.discrete)
      add(name + ".weight", {a + 1, h});  // the last row stands for a padded action
    else
      linear(name, h, a);
  };

  add("embed_timestep.weight", {architecture.time_rows, h});
  linear("embed_return", h, 1);
  linear("embed_state", h, s);
  action_embedding("embed_opoact");
  action_embedding("embed_curact");
  normalisation("embed_ln");
  for (std::size_t l = 0; l < architecture.layers; ++l) {
    const auto block = fmt::format("h.{}.", l);
    normalisation(block + "ln_1");
    convolution(block + "attn.c_attn", h, 3 * h);
    convolution(block + "attn.c_proj", h, h);
    normalisation(block + "ln_2");
    convolution(block + "mlp.c_fc", h, 4 * h);
    convolution(block + "mlp.c_proj", 4 * h, h);
  }
  normalisation("ln_f");
  linear("predict_opoact", a, n * h);
  for (std::size_t i = 0; i < n; ++i) linear(fmt::format("predict_curact.{}", i), a, h);
  if (architecture.readout == Readout::cat) linear("opo_obs_cat", h, 2 * h);
  if (architecture.auxiliary) {
    linear("predict_state", s, h);
    linear("predict_return", 1, 2 * n * h);
  }
}

const Tensor& ParameterLayout::operator[](std::string_view name) const {
  const auto found = std::find_if(tensors_.begin(), tensors_.end(), [&](const Tensor& t) { return t.name == name; });
  if (found == tensors_.end()) throw std::logic_error(fmt::format("no tensor '{}'", name));
  return *found;
}

void ParameterLayout::add(std::string name, std::vector<std::size_t> shape) {
  Tensor tensor{std::move(name), std::move(shape), size_};
  size_ += tensor.size();
  tensors_.push_back(std::move(tensor));
}

}  // namespace folk::sct
