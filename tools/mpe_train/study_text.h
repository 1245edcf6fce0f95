#pragma once
// The study's tables for the terminal.

#include <folk/mpe/study/study_tables.h>

#include <string>

namespace folk::tools {

/// All tables with the paper's numbers beside them, and what the words mean. `main`: of data with the released prey;
/// `second`: with another. What has not been run at all is one line.
std::string study_text(const mpe::StudyTables& main, const mpe::StudyTables& second);

}  // namespace folk::tools
