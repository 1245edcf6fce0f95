#pragma once
// The populations that an evolution went through, thinned where they are many.

#include <folk/analysis/evolution/dynamics.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace folk {

/// Generation 0 and every stride-th after it; the stride doubles whenever the numbers kept would be more than
/// most_numbers.
class PopulationHistory {
public:
  static constexpr std::size_t most_numbers = std::size_t{1} << 21;

  struct Row {
    std::uint64_t generation = 0;
    Population population;
  };

  /// Generations come in order.
  void add(std::uint64_t generation, const Population& population);

  std::uint64_t stride() const { return stride_; }
  const std::vector<Row>& rows() const { return rows_; }

  /// The mean population of the last quarter of the rows kept, as the program of Mathieu & Delahaye ranks by for its
  /// random models (there rounded down).
  Population mean_of_last_quarter() const;

  /// As it was written down. Rows are those that add() would have kept.
  static PopulationHistory restored(std::uint64_t stride, std::vector<Row> rows);

private:
  std::uint64_t stride_ = 1;
  std::vector<Row> rows_;
};

}  // namespace folk
