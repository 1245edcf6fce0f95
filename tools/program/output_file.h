#pragma once
// A file that a program will write at its end.

#include <filesystem>
#include <string>

namespace folk::tools {

/// Refuses before the work what could not be written after it, and takes away what a killed run left of such a write;
/// `option` ("--output") is what messages call it. Throws UsageError, EnvironmentError.
void require_writable(const std::filesystem::path& file, const std::string& option);

}  // namespace folk::tools
