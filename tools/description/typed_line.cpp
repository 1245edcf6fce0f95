#include <folk/tools/description/typed_line.h>

namespace folk::tools {

TypedLine typed_line(std::string_view line) {
  TypedLine typed;
  std::string word;
  const auto end_word = [&] {
    if (!typed.last_as_typed.empty()) typed.words.push_back(word);
    word.clear();
    typed.last_as_typed.clear();
  };
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (typed.quote == '\0' && (c == ' ' || c == '\t')) {
      end_word();
      continue;
    }
    typed.last_as_typed += c;
    if (c == typed.quote) {
      typed.quote = '\0';
    } else if (typed.quote == '\0' && (c == '\'' || c == '"')) {
      typed.quote = c;
    } else if (c == '\\' && typed.quote != '\'' && i + 1 < line.size()) {
      word += line[++i];
      typed.last_as_typed += line[i];
    } else {
      word += c;
    }
  }
  typed.words.push_back(word);
  return typed;
}

}  // namespace folk::tools
