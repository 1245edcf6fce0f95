#pragma once
// What ipd-judge found as text, CSV, JSON and files.

#include <folk/tools/ipd_judge/question.h>

#include <filesystem>
#include <ostream>
#include <string>

namespace folk::tools {

void write_text(std::ostream& out, const JudgeQuestion& question, const Judgement& found);

/// A row for each candidate, the likeliest first.
void write_csv(std::ostream& out, const JudgeQuestion& question, const Judgement& found);

/// One object; the form is in docs/ipd-judge.md.
void write_json(std::ostream& out, const JudgeQuestion& question, const Judgement& found);

/// The report as one page.
std::string html_page(const JudgeQuestion& question, const Judgement& found);

/// report.json and report.html in `folder`.
void write_files(const std::filesystem::path& folder, const JudgeQuestion& question, const Judgement& found);

}  // namespace folk::tools
