#include <folk/games/criterion.h>
#include <folk/games/error.h>
#include <folk/games/text_file.h>
#include <folk/mpe/pictures/curve_file.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace folk::mpe {
namespace {

constexpr double largest = 1e15;

std::vector<std::string_view> fields_of(std::string_view line) {
  if (line.ends_with('\r')) line.remove_suffix(1);
  std::vector<std::string_view> fields;
  for (;;) {
    const auto comma = line.find(',');
    fields.push_back(line.substr(0, comma));
    if (comma == std::string_view::npos) return fields;
    line.remove_prefix(comma + 1);
  }
}

}  // namespace

LearningCurve parse_curve(std::string_view text, const std::string& source, std::string_view column) {
  std::size_t number = 0;
  const auto refuse = [&](const std::string& what) {
    throw InputFileError(fmt::format("{}:{}: {}; name a CSV that mpe-train online wrote", excerpt(source, 1000),
                                     std::max<std::size_t>(1, number), what));
  };
  LearningCurve curve{source, {}, {}};
  std::size_t width = 0;
  std::size_t episodes = 0;
  std::size_t returns = 0;
  while (!text.empty()) {
    ++number;
    const auto end = std::min(text.find('\n'), text.size());
    const auto fields = fields_of(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (number == 1) {
      const auto place = [&](std::string_view name) {
        const auto found = std::find(fields.begin(), fields.end(), name);
        if (found == fields.end()) refuse(fmt::format("no column '{}'", name));
        return static_cast<std::size_t>(found - fields.begin());
      };
      width = fields.size();
      episodes = place("episodes");
      returns = place(column);
      continue;
    }
    if (fields.size() != width) refuse(fmt::format("{} fields: expected {}", fields.size(), width));
    try {
      const double at = parse_number(fields[episodes], "episodes", 0, largest);
      if (!curve.episodes.empty() && at <= curve.episodes.back())
        refuse(fmt::format("{} episodes after {}: evaluations follow each other", at, curve.episodes.back()));
      curve.episodes.push_back(at);
      curve.returns.push_back(parse_number(fields[returns], column, -largest, largest));
    } catch (const UsageError& error) {
      refuse(error.what());
    }
  }
  if (curve.episodes.empty()) refuse("no evaluation");
  return curve;
}

LearningCurve read_curve(const std::filesystem::path& path, std::string_view column) {
  auto curve = parse_curve(read_text_file(path), path.string(), column);
  curve.name = path.stem().string();
  return curve;
}

}  // namespace folk::mpe
