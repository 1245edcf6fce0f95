// Journals of evolutions: sealed or not, whatever is read is written as it was. The seal of most inputs is made here,
// as nobody guesses one.

#include <folk/analysis/evolution/evolution_journal.h>
#include <folk/analysis/play/signature.h>

#include <fmt/format.h>

#include "fuzz.h"

namespace {

constexpr std::uint64_t identity = 7;
constexpr std::size_t strategies = 3;

std::string sealed(std::string_view text) {
  std::string body(text.substr(0, text.rfind("seal ")));
  folk::Signature signature;
  signature.add(body);
  return body + fmt::format("seal {:016x}\n", signature.value());
}

void read_journal(std::string_view text) {
  const auto again = [&](const auto& state, auto reader) {
    const auto written = folk::journal_text(state, identity);
    folk::fuzz::require(folk::journal_text(reader(written, "fuzz", identity, strategies), identity) == written);
  };
  if (text.starts_with("folk fixation"))
    again(folk::read_fixation_journal(text, "fuzz", identity, strategies), folk::read_fixation_journal);
  else
    again(folk::read_evolution_journal(text, "fuzz", identity, strategies), folk::read_evolution_journal);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  folk::fuzz::only_folk_errors(data, size, read_journal);
  return folk::fuzz::only_folk_errors(data, size, [](std::string_view text) { read_journal(sealed(text)); });
}
