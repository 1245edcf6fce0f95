#include <folk/games/error.h>
#include <folk/games/stage_games/nfg_lexer.h>

#include <utility>

namespace folk {
namespace {

constexpr std::string_view blanks = " \t\r\n\v\f";
constexpr std::string_view ends_of_word = " \t\r\n\v\f{},\"";

}  // namespace

NfgLexer::NfgLexer(std::string_view text, std::string source)
    : rest_(text),
      source_(std::move(source)) {
  if (rest_.starts_with("\xEF\xBB\xBF")) rest_.remove_prefix(3);
}

void NfgLexer::refuse(std::size_t line, const std::string& message) const {
  throw InputFileError(excerpt(source_, 1000) + ":" + std::to_string(line) + ": " + message);
}

char NfgLexer::take() {
  const char c = rest_.front();
  rest_.remove_prefix(1);
  if (c == '\n') ++line_;
  return c;
}

NfgToken NfgLexer::quoted() {
  NfgToken token{NfgToken::Kind::text, {}, line_};
  take();
  while (!rest_.empty()) {
    const char c = take();
    if (c == '"') return token;
    if (c == '\\' && !rest_.empty() && (rest_.front() == '"' || rest_.front() == '\\'))
      token.value += take();
    else
      token.value += c;
  }
  refuse(token.line, "the text that begins '" + excerpt(token.value, 20) + "' never ends; close it with \"");
}

NfgToken NfgLexer::next() {
  while (!rest_.empty() && blanks.find(rest_.front()) != std::string_view::npos) take();
  if (rest_.empty()) return {NfgToken::Kind::end, {}, line_};
  switch (rest_.front()) {
    case '{': take(); return {NfgToken::Kind::open, "{", line_};
    case '}': take(); return {NfgToken::Kind::close, "}", line_};
    case ',': take(); return {NfgToken::Kind::comma, ",", line_};
    case '"': return quoted();
    default: break;
  }
  const std::string_view word = rest_.substr(0, rest_.find_first_of(ends_of_word));
  rest_.remove_prefix(word.size());
  const bool number = std::string_view("0123456789+-.").find(word.front()) != std::string_view::npos;
  return {number ? NfgToken::Kind::number : NfgToken::Kind::word, std::string(word), line_};
}

}  // namespace folk
