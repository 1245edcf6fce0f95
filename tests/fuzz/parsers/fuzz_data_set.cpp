// DataSet::parse: one file of a sound data set of one episode is replaced by the input. Its first byte says which: 'a'
// the first of data_files, ..., 't' the last, 'u' metadata.json. Whatever is read is finite throughout. Most changes to
// an array end at its size; the mutator here writes over bytes and keeps it.

#include <folk/games/random.h>
#include <folk/mpe/data/data_figures.h>
#include <folk/mpe/data/data_set.h>
#include <folk/sct/files/npy_file.h>

#include <cmath>
#include <cstdint>
#include <iterator>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "fuzz.h"

namespace {

using namespace folk::mpe;

/// An episode in which nothing moves.
const std::map<std::string, std::string>& sound_files() {
  static const std::map<std::string, std::string> files = [] {
    std::map<std::string, std::string> made;
    const Scenario scenario = Scenario::named("simple_tag");
    for (const DataFile& file : data_files(scenario.agents())) {
      folk::sct::NpyArray array{file.shape(scenario, scenario.episode_steps), {}};
      array.values.resize(scenario.episode_steps * file.width(scenario));
      made[file.name()] = npy_bytes(array, folk::sct::NpyType::float32);
    }
    return made;
  }();
  return files;
}

std::string chosen(char letter) {
  const auto files = data_files(4);
  const auto index = static_cast<std::size_t>(static_cast<unsigned char>(letter - 'a')) % (files.size() + 1);
  return index < files.size() ? files[index].name() : metadata_name;
}

void require_readable(const DataSet& data) {
  std::vector<float> row(24);
  for (const DataFile& file : data_files(data.agents())) {
    const NumberTable& table = data.table(file.field, file.agent);
    folk::fuzz::require(table.width() == file.width(data.scenario()) && table.rows() == data.transitions());
    for (std::size_t i = 0; i < table.rows(); ++i) {
      table.row(i, std::span(row).first(table.width()));
      for (std::size_t k = 0; k < table.width(); ++k)
        folk::fuzz::require(std::isfinite(row[k]) && row[k] == table.at(i, k));
    }
  }
  const DataFigures figures = data_figures(data);
  folk::fuzz::require(std::isfinite(figures.predator.mean) && std::isfinite(figures.prey.mean));
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t, unsigned seed) {
  static constexpr std::uint32_t words[] = {0,          1,          0x3F800000, 0x7F7FFFFF, 0x7F800000,
                                            0xFFC00000, 0x80000000, 0x00000001, 0x7FF00000, 0x47EFFFFF};
  folk::RandomStream random({.seed = seed});
  const auto below = [&](std::size_t bound) { return static_cast<std::size_t>(random() % bound); };
  for (std::size_t changes = 1 + below(4); changes > 0 && size > 0; --changes) {
    const std::size_t place = below(size);
    if (random.chance(0.5)) {
      data[place] = static_cast<std::uint8_t>(random());
      continue;
    }
    const std::uint32_t word = words[below(std::size(words))];
    for (std::size_t i = 0; i < 4 && place + i < size; ++i)
      data[place + i] = static_cast<std::uint8_t>(word >> (8 * i));
  }
  return size;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return folk::fuzz::only_folk_errors(data, size, [](std::string_view input) {
    const std::string replaced = input.empty() ? metadata_name : chosen(input.front());
    const std::string_view bytes = input.empty() ? input : input.substr(1);
    const auto file = [&](const std::string& name) -> std::optional<std::string_view> {
      if (name == replaced) return bytes;
      const auto found = sound_files().find(name);
      if (found == sound_files().end()) return std::nullopt;
      return found->second;
    };
    DataSetRules rules;
    rules.any_episode_length = true;
    const DataSet set = DataSet::parse(file, "fuzz", rules);
    require_readable(set);
    if (!set.record()) return;
    const auto again = parse_metadata(metadata_text(*set.record()), "again");
    folk::fuzz::require(again && metadata_text(*again) == metadata_text(*set.record()));
  });
}
