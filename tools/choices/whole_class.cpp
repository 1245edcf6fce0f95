#include <folk/strategies/names.h>
#include <folk/tools/choices/whole_class.h>

namespace folk::tools {

std::optional<MemoryClass> named_class(const std::string& spec) {
  const auto items = split_list(spec);
  return items.size() == 1 ? MemoryClass::parse(items[0]) : std::nullopt;
}

std::optional<MemoryClass> unlisted_class(const std::string& spec) {
  const auto members = named_class(spec);
  return members && members->size() > Integer(MemoryClass::most_listed) ? members : std::nullopt;
}

}  // namespace folk::tools
