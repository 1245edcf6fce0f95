#include <folk/tools/description/description.h>

#include <fmt/format.h>

#include <sstream>

namespace folk::tools {

std::vector<std::pair<int, std::string>> exit_codes(const Program& program) {
  std::vector<std::pair<int, std::string>> codes{{0, "done"}};
  if (!program.claim.empty()) codes.emplace_back(1, program.claim);
  codes.insert(codes.end(), {{2, "wrong usage"}, {3, "bad input file"}, {4, "anything else"}});
  return codes;
}

std::string help_text(const Program& program) {
  std::ostringstream text;
  text << "Usage: " << program.name << " " << program.usage << "\n\n" << program.summary << "\n\n" << program.options;
  text << "\nExamples:\n";
  for (const auto& example : program.examples) text << "  " << example << "\n";
  text << "\nExit codes:";
  const char* separator = " ";
  for (const auto& [code, meaning] : exit_codes(program)) {
    text << separator << code << " " << meaning;
    separator = ", ";
  }
  text << ".\n";
  return text.str();
}

}  // namespace folk::tools
