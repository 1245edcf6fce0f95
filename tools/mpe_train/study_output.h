#pragma once
// The study's tables as files: CSV, LaTeX, text, pictures and a page.

#include <folk/tools/mpe_train/study_text.h>

#include <folk/mpe/study/study_plan.h>
#include <folk/mpe/study/study_tables.h>

#include <filesystem>

namespace folk::tools {

/// Writes into `folder`, which is made if need be:
///
///   study.txt, study.html            everything, for people
///   scores.csv, accuracy.csv, ...    study_csv.h; of `second` with "trained_prey_" before the name
///   latex/tables.tex, ...            study_latex.h
///   pictures/blend_simple_tag.svg    study_pictures.h
///
/// each whole or not at all. Equal tables give equal bytes (of pictures: by the same gnuplot). Without gnuplot there
/// are no pictures, nor those of an earlier call, and the page says so. Throws EnvironmentError when something cannot
/// be written.
void write_study_files(const std::filesystem::path& folder, const mpe::StudyTables& main,
                       const mpe::StudyTables& second, const mpe::StudySettings& settings);

}  // namespace folk::tools
