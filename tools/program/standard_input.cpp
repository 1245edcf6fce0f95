#include <folk/tools/program/launch.h>
#include <folk/tools/program/standard_input.h>

#include <fmt/format.h>
#include <folk/games/error.h>
#include <folk/games/text_file.h>

#include <iostream>

namespace folk::tools {

std::string read_standard_input(std::string_view asked_by) {
  if (crew().ranks() > 1)
    throw UsageError(
        fmt::format("{}: a launcher gives the standard input to one rank of several; name a file", asked_by));
  static std::string reader;
  if (!reader.empty())
    throw UsageError(fmt::format("{}: the standard input can be read once, and {} has read it; name a file", asked_by,
                                 reader == asked_by ? "another " + reader : reader));
  reader = asked_by;
  std::string text;
  char block[65536];
  while (std::cin.read(block, sizeof block), std::cin.gcount() > 0) {
    text.append(block, static_cast<std::size_t>(std::cin.gcount()));
    if (text.size() > largest_text_file)
      refuse_file("standard input",
                  fmt::format("larger than {} MiB, which no file of this kind is; check what writes it",
                              largest_text_file >> 20U));
  }
  if (std::cin.bad()) refuse_file("standard input", "cannot be read");
  return text;
}

std::string read_file_or_input(const std::string& file, std::string_view asked_by) {
  return file == "-" ? read_standard_input(asked_by) : read_text_file(file);
}

}  // namespace folk::tools
