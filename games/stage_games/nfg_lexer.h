#pragma once
// The words of Gambit's text files: braces, quoted texts, numbers and bare words, with the line of each.

#include <cstddef>
#include <string>
#include <string_view>

namespace folk {

/// One word of an .nfg file.
struct NfgToken {
  enum class Kind { open, close, comma, text, number, word, end };

  Kind kind = Kind::end;
  std::string value;     ///< what stands between the quotes, or the word itself
  std::size_t line = 1;  ///< the line it begins on, counted from 1
};

/// Splits a text into words. In a quoted text \" stands for " and \\ for \; every other character, line ends too,
/// stands for itself.
class NfgLexer {
public:
  /// `text` must outlive the lexer. A byte order mark at its front is skipped.
  explicit NfgLexer(std::string_view text, std::string source);

  /// The next word; kind `end` for ever after the last. Throws InputFileError on a text without a closing quote.
  NfgToken next();

  /// Bytes not read yet.
  std::size_t left() const { return rest_.size(); }

  /// Throws InputFileError "source:LINE: message".
  [[noreturn]] void refuse(std::size_t line, const std::string& message) const;

private:
  NfgToken quoted();
  char take();

  std::string_view rest_;
  std::string source_;
  std::size_t line_ = 1;
};

}  // namespace folk
