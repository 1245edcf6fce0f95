#pragma once
// Which rows of a chunk are whose: the tokens of each window, and those of them whose hidden states are read.

#include <folk/sct/network/matrix.h>

#include <cstddef>
#include <span>
#include <vector>

namespace folk::sct {

/// Windows stand one after the other, their rounds one after the other, `round_tokens` rows a round. The last block
/// computes only the rows that somebody reads, the queries: the same `read` tokens of every round, in ascending order.
struct TokenRows {
  std::vector<Index> first_token;  ///< of each window; one more at the end: the number of rows
  std::vector<Index> first_query;  ///< likewise
  std::vector<Index> position;     ///< of each query among its window's tokens
  std::vector<Index> row;          ///< of each query among all rows
  bool all = false;                ///< every token is a query

  std::size_t windows() const { return first_token.size() - 1; }
  Index tokens() const { return first_token.back(); }
  Index queries() const { return first_query.back(); }
  Index window_tokens(std::size_t w) const { return first_token[w + 1] - first_token[w]; }
  Index window_queries(std::size_t w) const { return first_query[w + 1] - first_query[w]; }

  /// `rounds` of each window.
  TokenRows(std::span<const std::size_t> rounds, std::size_t round_tokens, std::span<const std::size_t> read);
  TokenRows() = default;
};

}  // namespace folk::sct
