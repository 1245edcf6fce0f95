#pragma once
// A whole page of HTML that needs nothing beside it.

#include <folk/tools/program/html.h>

#include <string>

namespace folk::tools {

/// A page with this title, style sheet and body.
std::string html_document(const std::string& title, const std::string& style, const Html& body);

/// The style of pages that judge something: .yes, .no and .open are words of judgement, .number, .name, .claim,
/// .verdict and .long columns of tables, .moves and pre are of one width, .row stands figures beside each other.
extern const char* const report_style;

}  // namespace folk::tools
