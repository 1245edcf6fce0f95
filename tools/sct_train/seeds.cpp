#include <folk/tools/sct_train/seeds.h>

#include <fmt/format.h>
#include <folk/games/error.h>

#include <algorithm>
#include <charconv>
#include <set>
#include <string_view>

namespace folk::tools {
namespace {

constexpr std::size_t most_seeds = 1000;

std::uint64_t parse_seed(std::string_view text, const std::string& whole) {
  std::uint64_t number = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || stop != text.data() + text.size())
    throw UsageError(fmt::format("--seeds '{}': expected whole numbers, as 1..5 or 1,4,9", excerpt(whole)));
  return number;
}

}  // namespace

std::vector<std::uint64_t> parse_seeds(const std::string& text) {
  std::vector<std::uint64_t> seeds;
  std::set<std::uint64_t> seen;
  const auto add = [&](std::uint64_t seed) {
    if (!seen.insert(seed).second)
      throw UsageError(fmt::format("--seeds '{}': {} is there twice", excerpt(text), seed));
    if (seen.size() > most_seeds)
      throw UsageError(fmt::format("--seeds '{}': more than {} seeds", excerpt(text), most_seeds));
    seeds.push_back(seed);
  };
  for (std::size_t begin = 0; begin <= text.size();) {
    const auto end = std::min(text.find(',', begin), text.size());
    const auto part = std::string_view(text).substr(begin, end - begin);
    const auto dots = part.find("..");
    const auto first = parse_seed(part.substr(0, dots), text);
    const auto last = dots == std::string_view::npos ? first : parse_seed(part.substr(dots + 2), text);
    if (last < first)
      throw UsageError(
          fmt::format("--seeds '{}': {} is before {}; the lower seed comes first", excerpt(text), last, first));
    for (std::uint64_t k = 0; k <= last - first; ++k) add(first + k);
    begin = end + 1;
  }
  return seeds;
}

std::filesystem::path of_seed(const std::filesystem::path& file, std::uint64_t seed) {
  std::error_code ignored;
  if (std::filesystem::exists(file, ignored) && !std::filesystem::is_regular_file(file, ignored)) return file;
  auto name = file.stem();
  name += fmt::format("-{}", seed);
  name += file.extension();
  return file.parent_path() / name;
}

}  // namespace folk::tools
