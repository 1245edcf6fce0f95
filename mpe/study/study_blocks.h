#pragma once
// Rows of the study's tables as blocks for readers: one scenario and level, a line a learner, a column a prey (or a
// point of a curve). All reports share this order.

#include <folk/mpe/study/study_tables.h>

#include <cstddef>
#include <string>
#include <vector>

namespace folk::mpe {

/// Cells are rows of the tables that the block was made of, which must outlive it; nullptr where there is no such row.
template <class Row>
struct StudyBlock {
  struct Line {
    std::string learner;
    std::vector<const Row*> cells;  ///< one a column
  };
  std::string scenario, level;
  std::vector<std::string> columns;  ///< the same in all blocks of a scenario
  std::vector<Line> lines;

  /// Whether any cell was run.
  bool begun() const;
};

/// Blocks by their scenarios' names, then in the order of the tables. Learners first, then who learned nothing: those
/// of the level's data, then those without data.
std::vector<StudyBlock<ScoreRow>> score_blocks(const StudyTables& tables);
std::vector<StudyBlock<BlendRow>> blend_blocks(const StudyTables& tables);  ///< columns "1", "0.7", ...
std::vector<StudyBlock<AccuracyRow>> accuracy_blocks(const StudyTables& tables);
/// Lines "SCT minus MADT", one for each other learner.
std::vector<StudyBlock<PairedRow>> paired_blocks(const StudyTables& tables);
/// Lines "sct, still", one a learner and prey; columns are what was asked for, "0", "80", ...
std::vector<StudyBlock<AskedRow>> asked_blocks(const StudyTables& tables);
/// Lines likewise; columns are the forcings.
std::vector<StudyBlock<ForcedRow>> forced_blocks(const StudyTables& tables);

/// Whom the tables speak of, in the tables' order, and how many seeds of each were examined.
struct StudyPlace {
  std::string scenario, level, learner;
  std::size_t seeds = 0;
};
std::vector<StudyPlace> study_places(const StudyTables& tables);

}  // namespace folk::mpe
