// Registry::roster: whatever is read has distinct names, and each single strategy's name that is no label reads back to
// itself.

#include <folk/strategies/registry.h>

#include <set>
#include <string>

#include "fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const folk::Registry registry = folk::Registry::standard();
  // Large families only cost time, and the files and programs that a name may stand for are not the parser's.
  const std::string_view input(reinterpret_cast<const char*>(data), size);
  for (const char* left_out : {"@", "memory(", "periodic(1", "periodic(2", "periodic(0", "periodic(.", "proba("})
    if (input.find(left_out) != std::string_view::npos && input != "memory(1,1)") return 0;
  return folk::fuzz::only_folk_errors(data, size, [](std::string_view text) {
    const auto roster = registry.roster(text);
    folk::fuzz::require(!roster.empty());
    folk::refuse_duplicates(roster);
    std::set<std::string> labels;
    for (const auto& item : folk::split_list(text))
      if (const auto label = folk::split_label(item).label) labels.insert(*label);
    for (const auto& strategy : roster)
      folk::fuzz::require(labels.contains(strategy.name) || registry.make(strategy.name).name == strategy.name);
  });
}
