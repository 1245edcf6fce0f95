// The particle world: a batch of episodes whose arrays numpy sees in place.

#include <folk/python/bindings/array.h>
#include <folk/python/bindings/parts.h>

#include <folk/games/error.h>
#include <folk/mpe/world/batch.h>
#include <folk/mpe/world/lanes.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

namespace folk::python {
namespace {

using BatchPtr = std::shared_ptr<mpe::Batch>;

BatchPtr made_batch(const std::string& scenario, std::size_t episodes, const std::string& rule, unsigned threads) {
  if (rule != "program" && rule != "paper")
    throw UsageError("reward_rule '" + excerpt(rule) + "': expected program or paper");
  if (episodes > mpe::block_lanes && episodes % mpe::block_lanes != 0)
    throw UsageError("a batch has up to 64 environments, or a multiple of 64");
  const auto rewards = rule == "program" ? mpe::RewardRule::program : mpe::RewardRule::paper;
  return std::make_shared<mpe::Batch>(mpe::Scenario::named(scenario, rewards), episodes, threads);
}

/// Rows [first, first + count) of all blocks as [block, lane, number]; `rows` is how many a block has.
py::array_t<double> numbers_of(const BatchPtr& batch, double* begin, std::size_t rows, std::size_t first,
                               std::size_t count) {
  constexpr auto number = static_cast<py::ssize_t>(sizeof(double));
  constexpr auto lanes = static_cast<py::ssize_t>(mpe::block_lanes);
  const auto blocks = static_cast<py::ssize_t>(batch->blocks());
  const py::capsule base(new BatchPtr(batch), [](void* kept) { delete static_cast<BatchPtr*>(kept); });
  return py::array_t<double>(
      {blocks, std::min(lanes, static_cast<py::ssize_t>(batch->size())), static_cast<py::ssize_t>(count)},
      {static_cast<py::ssize_t>(rows) * lanes * number, number, lanes * number}, begin + first * mpe::block_lanes,
      base);
}

py::array_t<double> observations_of(const BatchPtr& batch, std::size_t agent) {
  const auto& layout = batch->layout();
  if (agent >= layout.agents()) throw UsageError("there is no such agent");
  const std::size_t first = layout.observation_begin(agent);
  return numbers_of(batch, batch->block(0).observations, layout.observation_rows(), first,
                    layout.observation_begin(agent + 1) - first);
}

std::vector<std::string> agents_of(const BatchPtr& batch) {
  std::vector<std::string> names;
  for (std::size_t agent = 0; agent < batch->layout().agents(); ++agent)
    names.push_back(batch->scenario().entities[agent].name);
  return names;
}

}  // namespace

void add_mpe(py::module_& module) {
  py::class_<mpe::Batch, BatchPtr>(module, "Batch", "Episodes of one scenario, stepped together; folk.mpe shows it.")
      .def(py::init(&made_batch), py::arg("scenario"), py::arg("episodes"), py::arg("reward_rule"), py::arg("threads"))
      .def_property_readonly("agents", agents_of, "Names: the predators, then the prey.")
      .def_property_readonly(
          "episode_steps", [](const mpe::Batch& batch) { return batch.scenario().episode_steps; },
          "Steps of an episode.")
      .def("observations", observations_of, "A view of an agent's observations, [block, lane, number].",
           py::arg("agent"))
      .def(
          "rewards",
          [](const BatchPtr& batch) {
            const std::size_t rows = batch->layout().reward_rows();
            return numbers_of(batch, batch->block(0).rewards, rows, 0, rows);
          },
          "A view, [block, lane, agent].")
      .def(
          "actions",
          [](const BatchPtr& batch) {
            const std::size_t rows = batch->layout().action_rows();
            return numbers_of(batch, batch->block(0).actions, rows, 0, rows);
          },
          "A view, [block, lane, 2 x agent + axis].")
      .def("reset", &mpe::Batch::reset, py::call_guard<py::gil_scoped_release>(), "Places everything anew.",
           py::arg("seed"), py::arg("first"))
      .def("step", &mpe::Batch::step, py::call_guard<py::gil_scoped_release>(), "Steps every episode.");
}

}  // namespace folk::python
