#include <folk/games/utf8.h>

#include <boost/locale/utf.hpp>  // the header alone: nothing of Boost.Locale is linked

namespace folk {
namespace {

namespace utf = boost::locale::utf;

/// The length of the character at the front of a text, 1 where there is none.
std::size_t first_length(std::string_view text) {
  const char* end = text.data();
  const utf::code_point found = utf::utf_traits<char>::decode(end, text.data() + text.size());
  if (found == utf::illegal || found == utf::incomplete) return 1;
  return static_cast<std::size_t>(end - text.data());
}

}  // namespace

std::vector<std::string_view> utf8_characters(std::string_view text) {
  std::vector<std::string_view> characters;
  while (!text.empty()) {
    characters.push_back(text.substr(0, first_length(text)));
    text.remove_prefix(characters.back().size());
  }
  return characters;
}

}  // namespace folk
