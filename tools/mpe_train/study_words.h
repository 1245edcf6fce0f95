#pragma once
// What mpe-train study says beside its numbers, in its text and on its page.

#include <folk/mpe/study/study_tables.h>
#include <folk/mpe/study/study_words.h>

#include <optional>
#include <string>
#include <vector>

namespace folk::tools {

/// A word and what it means.
struct Legend {
  std::string word;
  std::string meaning;
};

std::vector<Legend> score_legend(const mpe::StudyTables& tables);
std::vector<Legend> accuracy_legend(const mpe::StudyTables& tables);
std::vector<Legend> paired_legend();
std::vector<Legend> blend_legend();
std::vector<Legend> forced_legend();
std::vector<Legend> asked_legend();

/// "Data whose prey was the released one".
std::string data_title(const mpe::StudyTables& tables);

/// How many of the scores that can be held against the paper's lie so to its numbers.
struct PaperCount {
  std::size_t compared = 0, above = 0, below = 0;
};
PaperCount score_count(const mpe::StudyTables& tables);

/// "of 120 scores that the paper has too, 30 are above and 12 below its number, ..."
std::string count_words(const PaperCount& count);

}  // namespace folk::tools
