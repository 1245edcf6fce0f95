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
constexpr Index most_tile_vectors = 2;  // one where only so many columns are left
constexpr Index block_depth = 256;      // rows of a packed panel: it stays in the first-level cache

template <class S>
struct Vector {
  using type [[gnu::vector_size(vector_bytes)]] = S;
  static constexpr Index lanes = vector_bytes / static_cast<int>(sizeof(S));
};

template <class S, Index vectors>
constexpr Index panel_columns = vectors* Vector<S>::lanes;

/// Rows [first, first + depth) of `columns` columns of b side by side, padded with zeros.
template <class S, Index vectors>
void pack(const Operand<S>& b, Index first, Index depth, Index column, Index columns, S* panel) {
  for (Index k = 0; k < depth; ++k) {
    const S* from = b.data + (first + k) * b.row_stride + column * b.column_stride;
    S* to = panel + k * panel_columns<S, vectors>;
    if (columns == panel_columns<S, vectors> && b.column_stride == 1) {
      std::memcpy(to, from, sizeof(S) * panel_columns<S, vectors>);  // of a size that the compiler knows
      continue;
    }
    for (Index j = 0; j < columns; ++j) to[j] = from[j * b.column_stride];
    std::fill(to + columns, to + panel_columns<S, vectors>, S(0));
  }
}

/// `rows` rows of c from as many of a and one panel.
template <class S, Index rows, Index vectors>
void tile(const S* a, Index row_stride, Index depth_stride, const S* panel, Index depth, S* c, Index c_stride,
          Index columns, bool add) {
  using V = typename Vector<S>::type;
  constexpr Index lanes = Vector<S>::lanes;
  constexpr Index width = panel_columns<S, vectors>;
  V sums[rows][vectors] = {};
  for (Index k = 0; k < depth; ++k) {
    V b[vectors];
    std::memcpy(b, panel + k * width, sizeof b);
#pragma GCC unroll 16
    for (Index r = 0; r < rows; ++r) {
      const S factor = a[r * row_stride + k * depth_stride];
#pragma GCC unroll 4
      for (Index v = 0; v < vectors; ++v) sums[r][v] += b[v] * factor;
    }
  }
  for (Index r = 0; r < rows; ++r) {
    S* out = c + r * c_stride;
    if (columns == width) {
      for (Index v = 0; v < vectors; ++v) {
        V sum = sums[r][v];
        if (add) {
          V old;
          std::memcpy(&old, out + v * lanes, sizeof old);
          sum += old;
        }
        std::memcpy(out + v * lanes, &sum, sizeof sum);
      }
    } else {
      std::array<S, static_cast<std::size_t>(width)> sum{};
      std::memcpy(sum.data(), sums[r], sizeof sum);
      for (Index j = 0; j < columns; ++j) out[j] = (add ? out[j] : S(0)) + sum[static_cast<std::size_t>(j)];
    }
  }
}

/// As many rows at a time as fit, then those that are left over at once.
template <class S, Index rows, Index vectors>
void tiles(const Operand<S>& a, Index first_row, Index first, Index depth, const S* panel, S* c, Index c_stride,
           Index columns, bool add) {
  Index r = first_row;
  for (; r + rows <= a.rows; r += rows)
    tile<S, rows, vectors>(a.data + r * a.row_stride + first * a.column_stride, a.row_stride, a.column_stride, panel,
                           depth, c + r * c_stride, c_stride, columns, add);
  if constexpr (rows > 1)
    if (r < a.rows) tiles<S, rows - 1, vectors>(a, r, first, depth, panel, c, c_stride, columns, add);
}

/// Columns [column, column + columns) of c, which fit one panel.
template <class S, Index vectors>
void multiply_panel(const Operand<S>& a, const Operand<S>& b, S* c, Index c_stride, Index column, Index columns,
                    bool add) {
  alignas(64) std::array<S, static_cast<std::size_t>(block_depth * panel_columns<S, vectors>)> panel;
  for (Index first = 0; first < a.columns; first += block_depth) {
    const Index block = std::min(block_depth, a.columns - first);
    pack<S, vectors>(b, first, block, column, columns, panel.data());
    tiles<S, tile_rows, vectors>(a, 0, first, block, panel.data(), c + column, c_stride, columns, add || first > 0);
  }
}

}  // namespace

template <class S>
void multiply(const Operand<S>& a, const Operand<S>& b, S* c, Index c_stride, bool add) {
  if (a.columns == 0 && !add)
    for (Index r = 0; r < a.rows; ++r) std::fill(c + r * c_stride, c + r * c_stride + b.columns, S(0));
  constexpr Index width = panel_columns<S, most_tile_vectors>;
  for (Index column = 0; column < b.columns; column += width) {
    const Index columns = std::min(width, b.columns - column);
    if (columns <= Vector<S>::lanes)
      multiply_panel<S, 1>(a, b, c, c_stride, column, columns, add);
    else
      multiply_panel<S, most_tile_vectors>(a, b, c, c_stride, column, columns, add);
  }
}

template void multiply(const Operand<float>&, const Operand<float>&, float*, Index, bool);
template void multiply(const Operand<double>&, const Operand<double>&, double*, Index, bool);

}  // namespace folk::sct
