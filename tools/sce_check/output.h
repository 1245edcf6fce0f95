#pragma once
// What sce-check found as text, CSV, JSON and files.

#include <folk/tools/sce_check/report.h>

#include <filesystem>
#include <ostream>
#include <string>

namespace folk::tools {

void write_text(std::ostream& out, const SceQuestion& question, const SceReport& report);

/// A row for each opponent.
void write_csv(std::ostream& out, const SceQuestion& question, const SceReport& report);

/// One object; the form is in docs/sce-check.md.
void write_json(std::ostream& out, const SceQuestion& question, const SceReport& report, bool with_command);

/// report.json, report.html and, where there is one, NAME.machine and its drawing, in `folder`.
void write_files(const std::filesystem::path& folder, const SceQuestion& question, const SceReport& report);

/// The report as one page with its pictures inside it. Where gnuplot or dot is missing, the page says so in their
/// place.
std::string html_page(const SceQuestion& question, const SceReport& report);

/// The extracted automaton as an @file holds it.
std::string machine_file(const SceQuestion& question, const ExtractedMachine& extracted);

/// A name for the extracted automaton: "sct_extracted".
std::string extracted_name(const SceQuestion& question);

}  // namespace folk::tools
