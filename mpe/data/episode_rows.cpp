#include <folk/games/error.h>
#include <folk/mpe/data/episode_rows.h>

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <utility>

namespace folk::mpe {
namespace {

/// Writes a number little-endian.
template <class Number>
void store(char* to, Number number) {
  using Word = std::conditional_t<sizeof(Number) == 8, std::uint64_t, std::uint32_t>;
  const auto word = std::bit_cast<Word>(number);
  for (std::size_t i = 0; i < sizeof(Word); ++i) to[i] = static_cast<char>((word >> (8 * i)) & 0xFFU);
}

/// From rows of 64 lanes to one row a lane: lane l's `width` numbers at to + l * stride.
template <class Number>
void transpose(char* to, std::size_t stride, const double* from, std::size_t width, std::size_t lanes) {
  for (std::size_t lane = 0; lane < lanes; ++lane)
    for (std::size_t column = 0; column < width; ++column)
      store(to + lane * stride + column * sizeof(Number), static_cast<Number>(from[column * block_lanes + lane]));
}

/// Data sets are read as floats, whatever they are written as. Only actions can be too large for one: everything else
/// is bounded by the physics.
void require_floats(const Layout& layout, const Block& block) {
  constexpr double largest = std::numeric_limits<float>::max();
  for (std::size_t row = 0; row < layout.action_rows(); ++row)
    for (std::size_t lane = 0; lane < block.lanes; ++lane)
      if (const double action = block.actions[row * block_lanes + lane]; std::abs(action) > largest)
        throw UsageError(
            fmt::format("agent {}: an action of {} does not fit a float, as a data set takes them", row / 2, action));
}

}  // namespace

EpisodeRows::EpisodeRows(const Layout& layout, sct::NpyType type, Finished finished)
    : type_(type),
      finished_(std::move(finished)),
      bytes_(data_files(layout.agents()).size()) {}

void EpisodeRows::make_room(const Layout& layout, std::size_t lanes) {
  const std::size_t rows = lanes * layout.scenario().episode_steps;
  for (const DataFile& file : data_files(layout.agents()))
    bytes_[data_file_index(file.field, file.agent)].resize(rows * file.width(layout.scenario()) * bytes_of(type_));
}

void EpisodeRows::put(const Layout& layout, DataFile file, const double* rows, std::size_t lanes, std::size_t step) {
  const std::size_t width = file.width(layout.scenario());
  const std::size_t row_bytes = width * bytes_of(type_);
  const std::size_t episode_bytes = row_bytes * layout.scenario().episode_steps;
  char* to = bytes_[data_file_index(file.field, file.agent)].data() + step * row_bytes;
  if (type_ == sct::NpyType::float64)
    transpose<double>(to, episode_bytes, rows, width, lanes);
  else
    transpose<float>(to, episode_bytes, rows, width, lanes);
}

void EpisodeRows::acted(const Layout& layout, const Block& block, const Moment& moment) {
  if (moment.step == 0) make_room(layout, block.lanes);
  require_floats(layout, block);
  for (std::size_t i = 0; i < layout.agents(); ++i) {
    put(layout, {DataField::observation, i}, block.observations + layout.observation_begin(i) * block_lanes,
        block.lanes, moment.step);
    put(layout, {DataField::action, i}, block.actions + 2 * i * block_lanes, block.lanes, moment.step);
  }
}

void EpisodeRows::stepped(const Layout& layout, const Block& block, const Moment& moment) {
  const std::size_t step = moment.step - 1;  // the row of the step that was taken
  for (std::size_t i = 0; i < layout.agents(); ++i) {
    put(layout, {DataField::next_observation, i}, block.observations + layout.observation_begin(i) * block_lanes,
        block.lanes, step);
    put(layout, {DataField::reward, i}, block.rewards + i * block_lanes, block.lanes, step);
  }
  // dones stay the zeros that make_room put there.
  if (moment.step == layout.scenario().episode_steps) finished_(bytes_, block.lanes);
}

}  // namespace folk::mpe
