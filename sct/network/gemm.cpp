#include <folk/sct/network/gemm.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

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

/// Neighbours are lanes that are `distance` apart. Their upper ones come from b and their lower ones from a: both from
/// the upper neighbour there, or both from the lower one.
template <class V, std::size_t distance, bool upper, std::size_t... lane>
V exchanged(V a, V b, std::index_sequence<lane...> /*lanes*/) {
  constexpr std::size_t lanes = sizeof...(lane);
  return __builtin_shufflevector(
      a, b, ((lane & distance) != 0 ? lanes + lane - (upper ? 0 : distance) : lane + (upper ? distance : 0))...);
}

/// Transposes a square: exchanges (i, j + distance) with (i + distance, j) in each block of twice the distance, for
/// this distance and all its doubles.
template <std::size_t distance, class V, std::size_t n>
void transpose(std::array<V, n>& rows) {
  if constexpr (distance < n) {
#pragma GCC unroll 16
    for (std::size_t i = 0; i < n; ++i) {
      if ((i & distance) != 0) continue;
      const V above = rows[i];
      const V below = rows[i + distance];
      rows[i] = exchanged<V, distance, false>(above, below, std::make_index_sequence<n>());
      rows[i + distance] = exchanged<V, distance, true>(above, below, std::make_index_sequence<n>());
    }
    transpose<2 * distance>(rows);
  }
}

/// Where b's columns are contiguous: rows [first, first + lanes) of a vector's width of columns, of which `columns` are
/// there and the others zeros, to rows that are `width` apart.
template <class S, Index width>
void pack_square(const Operand<S>& b, Index first, Index column, Index columns, S* to) {
  using V = typename Vector<S>::type;
  constexpr Index lanes = Vector<S>::lanes;
  std::array<V, static_cast<std::size_t>(lanes)> square;
  const S* from = b.data + first + column * b.column_stride;
  if (columns >= lanes) {
#pragma GCC unroll 16
    for (Index j = 0; j < lanes; ++j)
      std::memcpy(&square[static_cast<std::size_t>(j)], from + j * b.column_stride, sizeof(V));
  } else {
    square.fill(V{});
    for (Index j = 0; j < columns; ++j)
      std::memcpy(&square[static_cast<std::size_t>(j)], from + j * b.column_stride, sizeof(V));
  }
  transpose<1>(square);
#pragma GCC unroll 16
  for (Index j = 0; j < lanes; ++j) std::memcpy(to + j * width, &square[static_cast<std::size_t>(j)], sizeof(V));
}

/// Rows [first, first + depth) of `columns` columns of b side by side, padded with zeros.
template <class S, Index vectors>
void pack(const Operand<S>& b, Index first, Index depth, Index column, Index columns, S* panel) {
  constexpr Index width = panel_columns<S, vectors>;
  constexpr Index lanes = Vector<S>::lanes;
  Index k = 0;
  if (b.row_stride == 1)
    for (; k + lanes <= depth; k += lanes)
      for (Index v = 0; v < width; v += lanes)
        pack_square<S, width>(b, first + k, column + v, columns - v, panel + k * width + v);
  for (; k < depth; ++k) {
    const S* from = b.data + (first + k) * b.row_stride + column * b.column_stride;
    S* to = panel + k * width;
    if (columns == width && b.column_stride == 1) {
      for (Index v = 0; v < width; v += lanes) __builtin_prefetch(from + 8 * b.row_stride + v);
      std::memcpy(to, from, sizeof(S) * width);  // of a size that the compiler knows
      continue;
    }
    for (Index j = 0; j < columns; ++j) to[j] = from[j * b.column_stride];
    std::fill(to + columns, to + width, S(0));
  }
}

/// `rows` rows of c from as many of a and one panel. `turned`: a is a transpose, its columns contiguous and `a_stride`
/// apart; otherwise its rows are. A stride that is known to be 1 saves registers.
template <class S, Index rows, Index vectors, bool turned>
void tile(const S* a, Index a_stride, const S* panel, Index depth, S* c, Index c_stride, Index columns, bool add) {
  const Index row_stride = turned ? 1 : a_stride;
  const Index depth_stride = turned ? a_stride : 1;
  using V = typename Vector<S>::type;
  constexpr Index lanes = Vector<S>::lanes;
  constexpr Index width = panel_columns<S, vectors>;
  V sums[rows][vectors] = {};
  for (Index k = 0; k < depth; ++k) {
    V b[vectors];
#pragma GCC unroll 4
    for (Index v = 0; v < vectors; ++v) std::memcpy(&b[v], panel + k * width + v * lanes, sizeof(V));
    if constexpr (turned) __builtin_prefetch(a + (k + 16) * depth_stride + rows - 1);  // each k is on another line
#pragma GCC unroll 16
    for (Index r = 0; r < rows; ++r) {
      const S factor = a[r * row_stride + k * depth_stride];
#pragma GCC unroll 4
      for (Index v = 0; v < vectors; ++v) sums[r][v] += b[v] * factor;
    }
  }
  const bool whole = columns == width;  // else by way of a whole one
  alignas(64) std::array<S, static_cast<std::size_t>(rows * width)> part;
  S* out = whole ? c : part.data();
  const Index out_stride = whole ? c_stride : width;
#pragma GCC unroll 16
  for (Index r = 0; r < rows; ++r)
#pragma GCC unroll 4
    for (Index v = 0; v < vectors; ++v) {
      V sum = sums[r][v];
      if (add && whole) {
        V old;
        std::memcpy(&old, out + r * out_stride + v * lanes, sizeof old);
        sum += old;
      }
      std::memcpy(out + r * out_stride + v * lanes, &sum, sizeof sum);
    }
  if (whole) return;
  for (Index r = 0; r < rows; ++r)
    for (Index j = 0; j < columns; ++j)
      c[r * c_stride + j] = (add ? c[r * c_stride + j] : S(0)) + part[static_cast<std::size_t>(r * width + j)];
}

/// As many rows at a time as fit, then those that are left over at once.
template <class S, Index rows, Index vectors, bool turned>
void tiles(const Operand<S>& a, Index first_row, Index first, Index depth, const S* panel, S* c, Index c_stride,
           Index columns, bool add) {
  Index r = first_row;
  for (; r + rows <= a.rows; r += rows)
    tile<S, rows, vectors, turned>(a.data + r * a.row_stride + first * a.column_stride,
                                   turned ? a.column_stride : a.row_stride, panel, depth, c + r * c_stride, c_stride,
                                   columns, add);
  if constexpr (rows > 1)
    if (r < a.rows) tiles<S, rows - 1, vectors, turned>(a, r, first, depth, panel, c, c_stride, columns, add);
}

/// Columns [column, column + columns) of c, which fit one panel.
template <class S, Index vectors>
void multiply_panel(const Operand<S>& a, const Operand<S>& b, S* c, Index c_stride, Index column, Index columns,
                    bool add) {
  alignas(64) std::array<S, static_cast<std::size_t>(block_depth * panel_columns<S, vectors>)> panel;
  for (Index first = 0; first < a.columns; first += block_depth) {
    const Index block = std::min(block_depth, a.columns - first);
    pack<S, vectors>(b, first, block, column, columns, panel.data());
    const auto all = a.row_stride == 1 ? tiles<S, tile_rows, vectors, true> : tiles<S, tile_rows, vectors, false>;
    all(a, 0, first, block, panel.data(), c + column, c_stride, columns, add || first > 0);
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
