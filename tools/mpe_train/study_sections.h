#pragma once
// The parts of the study's page.

#include <folk/tools/mpe_train/study_words.h>
#include <folk/tools/program/html.h>

#include <folk/mpe/study/study_plan.h>
#include <folk/mpe/study/study_tables.h>

#include <map>
#include <string>

namespace folk::tools {

/// What was drawn, by the pictures' names (study_pictures.h), as SVG; where no picture could be drawn, why.
struct DrawnPictures {
  std::map<std::string, std::string> svgs;
  std::string missing;
};

/// How much of the plan is done: a line a scenario and level, "2 of 3" seeds a learner.
Html progress_table(const mpe::StudyTables& tables, const mpe::StudySettings& settings);

/// The same in a sentence, of both tables: "120 of 141 jobs are done".
std::string progress_words(const mpe::StudyTables& main, const mpe::StudyTables& second,
                           const mpe::StudySettings& settings);

/// Everything about one data prey. What was not run at all is left out but for a line that says so.
Html data_section(const mpe::StudyTables& tables, const DrawnPictures& pictures);

}  // namespace folk::tools
