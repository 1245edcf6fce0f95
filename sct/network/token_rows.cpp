#include <folk/sct/network/token_rows.h>

namespace folk::sct {

TokenRows::TokenRows(std::span<const std::size_t> rounds, std::size_t round_tokens, std::span<const std::size_t> read)
    : first_token{0},
      first_query{0},
      all(read.size() == round_tokens) {
  for (const auto length : rounds) {
    for (std::size_t t = 0; t < length; ++t)
      for (const auto token : read) {
        position.push_back(index(t * round_tokens + token));
        row.push_back(first_token.back() + position.back());
      }
    first_token.push_back(first_token.back() + index(length * round_tokens));
    first_query.push_back(index(position.size()));
  }
}

}  // namespace folk::sct
