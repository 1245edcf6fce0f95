// Policy files of the particle world, of all kinds: whatever is read can play a side of a scenario, and what can be
// written is read back as the same policy. Most changes to a file end at its offsets or at its checksum; the mutator
// here changes names, shapes, types, texts and numbers, puts the file together again and mends the checksum.

#include <folk/games/random.h>
#include <folk/mpe/players/any_policy.h>
#include <folk/mpe/players/bcq_policy.h>
#include <folk/mpe/players/policy_file.h>
#include <folk/mpe/players/transformer_policy.h>
#include <folk/mpe/players/window_policy.h>
#include <folk/mpe/world/batch.h>
#include <folk/sct/files/safetensors.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

#include "../../mpe/players/safetensors_draft.h"
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

template <class Map>
auto any_of(RandomStream& random, Map& map) {
  return std::next(map.begin(), static_cast<std::ptrdiff_t>(below(random, map.size())));
}

void change_metadata(RandomStream& random, SafetensorsDraft& draft) {
  static const char* const keys[] = {"format", "scenario", "side", "squash", "note"};
  static const char* const values[] = {"folk-mpe-1",
                                       "folk-mpe-window-1",
                                       "folk-mpe-bcq-1",
                                       "folk-mpe-transformer-1",
                                       "folk-mpe-2",
                                       "simple_tag",
                                       "simple_world",
                                       "predators",
                                       "prey",
                                       "tanh",
                                       "clamp",
                                       "",
                                       "\n",
                                       "0",
                                       "1",
                                       "2",
                                       "3",
                                       "16",
                                       "26",
                                       "4096",
                                       "18446744073709551615",
                                       "-1",
                                       "0.5",
                                       "1e300",
                                       "1e-300",
                                       "nan",
                                       "1 2 3",
                                       "0 0 0",
                                       "1e-45 3e38 -1",
                                       "true",
                                       "false",
                                       "own",
                                       "cat",
                                       "add",
                                       "token",
                                       "teacher",
                                       "selfconf",
                                       "composite",
                                       "action_only"};
  const std::string key =
      draft.metadata.empty() || random.chance(0.3) ? pick(random, keys) : any_of(random, draft.metadata)->first;
  if (random.chance(0.2))
    draft.metadata.erase(key);
  else
    draft.metadata[key] = pick(random, values);
}

std::string any_name(RandomStream& random, const SafetensorsDraft& draft) {
  static const char* const prefixes[] = {"", "agent0.", "agent1.", "agent2.", "agent3.", "agent1.decoder.", "h.1."};
  static const char* const layers[] = {"fc1.", "fc2.", "fc3.", "fc4.", "in_fn.", "norm.", "scale.", "opo_obs_cat."};
  static const char* const parts[] = {"weight", "bias",      "running_mean", "running_var", "num_batches_tracked",
                                      "mean",   "deviation", "variance"};
  if (random.chance(0.2)) return any_of(random, draft.tensors)->first;
  return std::string(pick(random, prefixes)) + pick(random, layers) + pick(random, parts);
}

/// Another shape, most often with the numbers that it asks for.
void change_shape(RandomStream& random, SafetensorsDraft::Tensor& tensor) {
  static constexpr std::uint64_t sides[] = {0,  1,  2,  3,  4,    6,    14,          16,   17,
                                            18, 22, 24, 48, 4096, 4097, 1ULL << 62U, ~0ULL};
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
  const auto one = any_of(random, draft.tensors);
  const std::string name = one->first;
  switch (below(random, 6)) {
    case 0: draft.tensors.erase(name); break;
    case 1: draft.tensors[any_name(random, draft)] = SafetensorsDraft::Tensor(one->second); break;
    case 2: change_shape(random, one->second); break;
    case 3: one->second.dtype = pick(random, types); break;
    case 4: {  // under another name
      auto tensor = one->second;
      const std::string other = any_name(random, draft);
      draft.tensors.erase(name);
      draft.tensors[other] = std::move(tensor);
      break;
    }
    default: change_number(random, draft, name);
  }
}

/// Gives a transformer the checksum that the reader asks for.
void mend_checksum(SafetensorsDraft& draft) {
  if (!draft.metadata.contains("checksum")) return;
  try {
    parse_transformer_policy(draft.bytes(), "");
  } catch (const folk::InputFileError& error) {
    const std::string_view message = error.what();
    constexpr std::string_view before = ": checksum ";
    if (message.starts_with(before)) draft.metadata["checksum"] = message.substr(before.size(), 16);
  }
}

void require_finite(const std::vector<float>& numbers) {
  for (const float number : numbers) folk::fuzz::require(std::isfinite(number));
}

/// What is written once is written again when it was read.
template <class Parse, class Write>
void require_read_again(std::string_view bytes, Parse parse, Write write) {
  const std::string once = write(parse(bytes, "fuzz"));
  folk::fuzz::require(write(parse(once, "fuzz")) == once);
}

/// Its numbers are finite, and it is written and read again unless Folk's own form has no place for it.
void require_sound(const Policy& policy) {
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

void require_kept(std::string_view bytes) {
  const auto metadata = folk::sct::parse_safetensors(bytes, "fuzz").metadata;
  const auto found = metadata.find("format");
  const std::string format = found == metadata.end() ? std::string() : found->second;
  if (format == window_policy_format)
    require_read_again(bytes, parse_window_policy, window_policy_bytes);
  else if (format == bcq_policy_format)
    require_read_again(bytes, parse_bcq_policy, bcq_policy_bytes);
  else if (format == transformer_format)
    require_read_again(bytes, parse_transformer_policy, transformer_policy_bytes);
  else
    require_sound(parse_policy(bytes, "fuzz"));
}

/// The controller of a side of a scenario, or nothing when the policy is not for it. Throws InputFileError for what is
/// no policy.
std::optional<Controller> controller_of(std::string_view bytes, Side side, const Scenario& scenario) {
  try {
    return any_policy_controller("fuzz", bytes, "fuzz", side, scenario);
  } catch (const folk::UsageError&) {
    return std::nullopt;
  }
}

/// Two steps, without the world's: what was done may be too much for it.
void play(const Controller& controller, Side side, const Scenario& scenario) {
  const Layout layout(scenario);
  Batch batch(scenario, 1);
  batch.reset(1);
  const auto agents = agents_of(layout, side);
  const auto team = controller.team(layout, side);
  folk::fuzz::require(team.size() == agents.size());
  for (Moment moment; moment.step < 2; ++moment.step)
    for (std::size_t i = 0; i < team.size(); ++i) {
      if (moment.step == 0) team[i]->start(layout, batch.block(0), agents[i], moment);
      team[i]->act(layout, batch.block(0), agents[i], moment);
    }
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
    if (random.chance(0.9)) mend_checksum(draft);
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
    for (const char* name : {"simple_tag", "simple_world"})
      for (const Side side : {Side::predators, Side::prey}) {
        const auto scenario = Scenario::named(name);
        const auto controller = controller_of(bytes, side, scenario);  // InputFileError is a right answer
        if (!controller) continue;
        try {
          play(*controller, side, scenario);
          require_kept(bytes);
        } catch (const folk::Error&) {
          folk::fuzz::require(false);  // what was read is refused elsewhere
        }
        return;
      }
    folk::fuzz::require(false);  // a policy for nobody
  });
}
