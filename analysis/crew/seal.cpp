#include <folk/analysis/crew/seal.h>
#include <folk/analysis/play/signature.h>
#include <folk/games/error.h>

#include <fmt/format.h>

namespace folk {

std::uint64_t seal_of(std::string_view text) {
  Signature signature;
  signature.add(text);
  return signature.value();
}

std::string sealed(std::string text) {
  text += fmt::format("seal {:016x}\n", seal_of(text));
  return text;
}

std::string_view unsealed(std::string_view text, std::string_view title, const std::string& source) {
  if (text.substr(0, text.find('\n')) != title)
    refuse_file(source, fmt::format("not a journal of this kind of run (\"{}\"): name another file", title));
  const auto seal = text.rfind("seal ");
  if (seal == std::string_view::npos || text[seal - 1] != '\n' ||
      text.substr(seal) != fmt::format("seal {:016x}\n", seal_of(text.substr(0, seal))))
    refuse_file(source, "a journal that is damaged or cut off: delete it to begin anew");
  return text.substr(title.size(), seal - title.size());
}

void refuse_other_run(const std::string& source) {
  refuse_file(source,
              "the journal of another run (another roster, model, start or seed): name another file or delete it");
}

}  // namespace folk
