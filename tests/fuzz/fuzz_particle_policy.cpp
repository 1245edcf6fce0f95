// parse_policy of the particle world: whatever is read can play the side and scenario that it says it is for, and what
// can be written is read back as the same policy. Most changes to a file end at its offsets; the mutator here changes
// names, shapes, types, texts and numbers, and puts the file together again.

#include <folk/games/random.h>
#include <folk/mpe/players/policy_file.h>
#include <folk/mpe/world/batch.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <string>
#include <vector>

#include "../mpe/players/safetensors_draft.h"
#include "fuzz.h"

namespace {

using namespace folk::mpe;
using folk::RandomStream;
using folk::mpe::testing::SafetensorsDraft;

std::size_t below(RandomStream& random, std::size_t bound) { return static_cast<std::size_t>(random() % bound); }

template <class T, std::size_t n>
T pick(RandomStream& random, const T (&from)[n]) {
  return from[below(random, n)];
}

void change_metadata(RandomStream& random, SafetensorsDraft& draft) {
  static const char* const keys[] = {"format", "scenario", "side", "squash", "note"};
  static const char* const values[] = {"folk-mpe-1", "simple_tag", "simple_world", "predators", "prey", "tanh",
                                       "clamp",      "",           "folk-mpe-2",   "\n"};
  const std::string key = pick(random, keys);
  if (random.chance(0.2))
    draft.metadata.erase(key);
  else
    draft.metadata[key] = pick(random, values);
}

std::string any_name(RandomStream& random) {
  static const char* const prefixes[] = {"", "agent0.", "agent1.", "agent2.", "agent3."};
  static const char* const layers[] = {"fc1.", "fc2.", "fc3.", "fc4.", "in_fn."};
  static const char* const parts[] = {"weight", "bias", "running_mean", "running_var", "num_batches_tracked"};
  return std::string(pick(random, prefixes)) + pick(random, layers) + pick(random, parts);
}

/// Another shape, most often with the numbers that it asks for.
void change_shape(RandomStream& random, SafetensorsDraft::Tensor& tensor) {
  static constexpr std::uint64_t sides[] = {0, 1, 2, 3, 4, 14, 16, 22, 24, 4096, 4097, 1ULL << 62U, ~0ULL};
  if (tensor.shape.empty() || random.chance(0.1)) tensor.shape.push_back(pick(random, sides));
  if (random.chance(0.1)) tensor.shape.pop_back();
  if (!tensor.shape.empty()) tensor.shape[below(random, tensor.shape.size())] = pick(random, sides);
  std::uint64_t bytes = sizeof(float);
  for (const auto side : tensor.shape) bytes = side > 4096 ? 0 : bytes * side;
  if (bytes <= 4096 && random.chance(0.8)) tensor.data.resize(bytes);
}

void change_number(RandomStream& random, SafetensorsDraft& draft, const std::string& name) {
  static constexpr float numbers[] = {0, -0.0F, 1, -1, 3e38F, -3e38F, 1e-45F, NAN, INFINITY};
  const std::size_t count = draft.tensors[name].data.size() / sizeof(float);
  if (count > 0) draft.set_number(name, below(random, count), pick(random, numbers));
}

void change_tensor(RandomStream& random, SafetensorsDraft& draft) {
  static const char* const types[] = {"F32", "F64", "F16", "I64", ""};
  const auto one = std::next(draft.tensors.begin(), static_cast<std::ptrdiff_t>(below(random, draft.tensors.size())));
  const std::string name = one->first;
  switch (below(random, 6)) {
    case 0: draft.tensors.erase(name); break;
    case 1: draft.tensors[any_name(random)] = SafetensorsDraft::Tensor(one->second); break;
    case 2: change_shape(random, one->second); break;
    case 3: one->second.dtype = pick(random, types); break;
    case 4: {  // under another name
      auto tensor = one->second;
      draft.tensors.erase(name);
      draft.tensors[any_name(random)] = std::move(tensor);
      break;
    }
    default: change_number(random, draft, name);
  }
}

void require_finite(const std::vector<float>& numbers) {
  for (const float number : numbers) folk::fuzz::require(std::isfinite(number));
}

/// A policy that was read acts for its agents, and is written and read again unless Folk's own form has no place for
/// it.
void require_sound(const Policy& policy) {
  const Layout layout(Scenario::named(policy.scenario));
  const auto controller = policy_controller("fuzz", policy, policy.side, layout.scenario());
  Batch batch(layout.scenario(), 1);
  batch.reset(1);
  for (std::size_t agent = 0; agent < layout.agents(); ++agent)
    if (side_of(layout, agent) == policy.side) controller.player(layout, agent)->act(layout, batch.block(0), agent, {});
  for (const auto& network : policy.networks) {
    require_finite(network.parameters);
    if (!network.normalisation) continue;
    for (const auto* numbers : {&network.normalisation->weight, &network.normalisation->bias,
                                &network.normalisation->mean, &network.normalisation->variance})
      require_finite(*numbers);
  }
  if (policy.networks.front().normalisation) return;
  const std::string once = policy_bytes(policy);
  folk::fuzz::require(policy_bytes(parse_policy(once, "fuzz")) == once);
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed) {
  RandomStream random({.seed = seed});
  try {
    auto draft = SafetensorsDraft::of({reinterpret_cast<const char*>(data), size});
    for (std::size_t changes = 1 + below(random, 3); changes > 0; --changes) {
      if (draft.tensors.empty() || random.chance(0.2))
        change_metadata(random, draft);
      else
        change_tensor(random, draft);
    }
    const std::string bytes = draft.bytes();
    if (bytes.size() > most) return size;
    std::copy(bytes.begin(), bytes.end(), data);
    return bytes.size();
  } catch (const folk::Error&) {
    return size;  // no such file any more
  }
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return folk::fuzz::only_folk_errors(data, size, [](std::string_view bytes) {
    const Policy policy = parse_policy(bytes, "fuzz");
    try {
      require_sound(policy);
    } catch (const folk::Error&) {
      folk::fuzz::require(false);  // what was read is refused elsewhere
    }
  });
}
