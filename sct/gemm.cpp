#include <folk/sct/gemm.h>

#include <algorithm>
#include <array>
#include <cstring>

namespace folk::sct {
namespace {

#if defined(__AVX512F__)
constexpr int vector_bytes = 64;
constexpr Index tile_rows = 12;  // 24 sums, 2 columns of b and what is broadcast fit the 32 registers
#elif defined(__AVX__)
constexpr int vector_bytes = 32;
constexpr Index tile_rows = 6;
#else
constexpr int vector_bytes = 16;
constexpr Index tile_rows = 6;
#endif
constexpr Index tile_vectors = 2;
constexpr Index block_depth = 256;  // rows of a packed panel: it stays in the first-level cache

template <class S>
struct Vector {
  using type [[gnu::vector_size(vector_bytes)]] = S;
  static constexpr Index lanes = vector_bytes / static_cast<int>(sizeof(S));
};

template <class S>
constexpr Index panel_columns = tile_vectors* Vector<S>::lanes;

/// Rows [first, first + depth) of `columns` columns of b side by side, padded with zeros.
template <class S>
void pack(const Operand<S>& b, Index first, Index depth, Index column, Index columns, S* panel) {
  for (Index k = 0; k < depth; ++k) {
    const S* from = b.data + (first + k) * b.row_stride + column * b.column_stride;
    S* to = panel + k * panel_columns<S>;
    for (Index j = 0; j < columns; ++j) to[j] = from[j * b.column_stride];
    std::fill(to + columns, to + panel_columns<S>, S(0));
  }
}

/// `rows` rows of c from as many of a and one panel.
template <class S, Index rows>
void tile(const S* a, Index row_stride, Index depth_stride, const S* panel, Index depth, S* c, Index c_stride,
          Index columns, bool add) {
  using V = typename Vector<S>::type;
  constexpr Index lanes = Vector<S>::lanes;
  V sums[rows][tile_vectors] = {};
  for (Index k = 0; k < depth; ++k) {
    V b[tile_vectors];
    std::memcpy(b, panel + k * panel_columns<S>, sizeof b);
#pragma GCC unroll 16
    for (Index r = 0; r < rows; ++r) {
      const S factor = a[r * row_stride + k * depth_stride];
#pragma GCC unroll 4
      for (Index v = 0; v < tile_vectors; ++v) sums[r][v] += b[v] * factor;
    }
  }
  for (Index r = 0; r < rows; ++r) {
    S* out = c + r * c_stride;
    if (columns == panel_columns<S>) {
      for (Index v = 0; v < tile_vectors; ++v) {
        V sum = sums[r][v];
        if (add) {
          V old;
          std::memcpy(&old, out + v * lanes, sizeof old);
          sum += old;
        }
        std::memcpy(out + v * lanes, &sum, sizeof sum);
      }
    } else {
      std::array<S, static_cast<std::size_t>(panel_columns<S>)> sum{};
      std::memcpy(sum.data(), sums[r], sizeof sum);
      for (Index j = 0; j < columns; ++j) out[j] = (add ? out[j] : S(0)) + sum[static_cast<std::size_t>(j)];
    }
  }
}

/// The rows that are left over, a few at a time.
template <class S, Index rows>
void tiles(const Operand<S>& a, Index first_row, Index first, Index depth, const S* panel, S* c, Index c_stride,
           Index columns, bool add) {
  Index r = first_row;
  for (; r + rows <= a.rows; r += rows)
    tile<S, rows>(a.data + r * a.row_stride + first * a.column_stride, a.row_stride, a.column_stride, panel, depth,
                  c + r * c_stride, c_stride, columns, add);
  if constexpr (rows > 1)
    if (r < a.rows) tiles<S, rows / 2>(a, r, first, depth, panel, c, c_stride, columns, add);
}

}  // namespace

template <class S>
void multiply(const Operand<S>& a, const Operand<S>& b, S* c, Index c_stride, bool add) {
  alignas(64) std::array<S, static_cast<std::size_t>(block_depth * panel_columns<S>)> panel;
  const Index depth = a.columns;
  if (depth == 0 && !add)
    for (Index r = 0; r < a.rows; ++r) std::fill(c + r * c_stride, c + r * c_stride + b.columns, S(0));
  for (Index column = 0; column < b.columns; column += panel_columns<S>) {
    const Index columns = std::min(panel_columns<S>, b.columns - column);
    for (Index first = 0; first < depth; first += block_depth) {
      const Index block = std::min(block_depth, depth - first);
      pack(b, first, block, column, columns, panel.data());
      tiles<S, tile_rows>(a, 0, first, block, panel.data(), c + column, c_stride, columns, add || first > 0);
    }
  }
}

template void multiply(const Operand<float>&, const Operand<float>&, float*, Index, bool);
template void multiply(const Operand<double>&, const Operand<double>&, double*, Index, bool);

}  // namespace folk::sct
