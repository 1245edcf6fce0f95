#pragma once
// The populations that an evolution went through, thinned where they are many.

#include <folk/analysis/evolution/dynamics.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace folk {

/// The first generations, in which most happens, and every stride-th after them; the stride doubles whenever the
/// numbers kept would be more than most_numbers.
class PopulationHistory {
public:
  static constexpr std::size_t most_numbers = std::size_t{1} << 21;

  /// So many generations of n strategies are kept whatever the stride: 256, fewer of very many strategies.
  static std::uint64_t always_kept(std::size_t strategies);

  struct Row {
    std::uint64_t generation = 0;
    Population population;
  };

  /// Generations come in order.
  void add(std::uint64_t generation, const Population& population);

  std::uint64_t stride() const { return stride_; }
  const std::vector<Row>& rows() const { return rows_; }

  /// The mean population of the rows kept of the last quarter of the generations, as the program of Mathieu & Delahaye
  /// ranks by for its random models (there rounded down).
  Population mean_of_last_quarter() const;

  /// As it was written down: what rows() and stride() were.
  static PopulationHistory restored(std::uint64_t stride, std::vector<Row> rows);

private:
  std::uint64_t stride_ = 1;
  std::vector<Row> rows_;
};

}  // namespace folk
