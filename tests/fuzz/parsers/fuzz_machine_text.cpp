// read_machines and read_machine_line: whatever is read is written and read back unchanged.

#include <folk/strategies/machine_text.h>

#include "fuzz.h"

namespace {

void read_as_file(std::string_view text) {
  for (const auto& [name, machine] : folk::read_machines(text, "fuzz")) {
    const std::string written = folk::write_machine(name, machine);
    try {
      const auto again = folk::read_machines(written, "written");
      folk::fuzz::require(again.size() == 1 && again[0].name == name && again[0].machine == machine);
    } catch (const folk::Error&) {
      folk::fuzz::require(false);  // what Folk writes it reads
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  folk::fuzz::only_folk_errors(data, size, read_as_file);
  return folk::fuzz::only_folk_errors(data, size, folk::read_machine_line);
}
