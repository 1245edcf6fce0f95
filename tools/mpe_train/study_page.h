#pragma once
// The study as one HTML page that needs no other file.

#include <folk/tools/mpe_train/study_sections.h>

#include <folk/mpe/study/study_plan.h>
#include <folk/mpe/study/study_tables.h>

#include <string>

namespace folk::tools {

/// The budget, what is done, how to read it, all tables with the paper's numbers beside them, and the pictures.
std::string study_page(const mpe::StudyTables& main, const mpe::StudyTables& second, const mpe::StudySettings& settings,
                       const DrawnPictures& pictures);

}  // namespace folk::tools
