#include <folk/games/error.h>
#include <folk/tools/program/picture_option.h>

#include <fmt/format.h>

namespace folk::tools {

std::optional<std::string> picture_extension(const po::variables_map& values) {
  if (values.count("plot") == 0) return std::nullopt;
  const auto extension = text_option(values, "plot");
  if (extension != "svg" && extension != "png" && extension != "pdf")
    throw UsageError(fmt::format("--plot '{}': expected svg, png or pdf", excerpt(extension)));
  if (values.count("output") == 0) throw UsageError("--plot needs a folder for its pictures: give --output DIR");
  return extension;
}

}  // namespace folk::tools
