// parse_recording: whatever is read is written and read back as the same, and can be replayed.

#include <folk/games/random.h>
#include <folk/mpe/evaluation/recording_file.h>
#include <folk/mpe/evaluation/replay.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <string>

#include "fuzz.h"

namespace {

using folk::mpe::EpisodeRecord;

bool same(const EpisodeRecord& one, const EpisodeRecord& other) {
  const auto same_row = [](const EpisodeRecord::Row& a, const EpisodeRecord::Row& b) {
    return a.state == b.state && a.actions == b.actions && a.observations == b.observations && a.rewards == b.rewards;
  };
  return one.scenario.name == other.scenario.name && one.number == other.number &&
         std::equal(one.rows.begin(), one.rows.end(), other.rows.begin(), other.rows.end(), same_row);
}

}  // namespace

/// Changes fields of the rows and leaves the header alone: few other changes get past it.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed) {
  static constexpr const char* fields[] = {"0",
                                           "-0",
                                           "1",
                                           "2",
                                           "0.5",
                                           "-1e-300",
                                           "5e-324",
                                           "1e100",
                                           "-1e99",
                                           "1e101",
                                           "1e400",
                                           "nan",
                                           "inf",
                                           "",
                                           " 1",
                                           "+1",
                                           "0.1",
                                           "1.5",
                                           "7,7",
                                           "1\n1",
                                           "\n",
                                           "0x1p3",
                                           "1e",
                                           "-",
                                           "1e-400",
                                           "123456789.123456789",
                                           "18446744073709551615"};
  folk::RandomStream random({.seed = seed});
  const auto below = [&](std::size_t bound) { return static_cast<std::size_t>(random() % bound); };
  std::string text(reinterpret_cast<const char*>(data), size);
  const std::size_t header = std::min(text.find('\n'), size);
  for (std::size_t changes = 1 + below(4); changes > 0; --changes) {
    const std::size_t begin =
        std::min(text.find_first_of(",\n", header + below(text.size() - header + 1)), text.size());
    const std::size_t end = std::min(text.find_first_of(",\n", std::min(begin + 1, text.size())), text.size());
    if (begin == text.size()) continue;
    text.replace(begin + 1, end - begin - 1, fields[below(std::size(fields))]);
  }
  std::copy_n(text.begin(), std::min(text.size(), most), data);
  return std::min(text.size(), most);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return folk::fuzz::only_folk_errors(data, size, [](std::string_view text) {
    const auto episodes = folk::mpe::parse_recording(text, "fuzz.csv");
    const auto back = folk::mpe::parse_recording(folk::mpe::recording_text(episodes), "fuzz.csv");
    folk::fuzz::require(std::equal(episodes.begin(), episodes.end(), back.begin(), back.end(), same));
    for (const auto& episode : episodes)
      folk::fuzz::require(folk::mpe::replay(episode).steps + 1 == episode.rows.size());
  });
}
