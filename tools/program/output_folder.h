#pragma once
// The option that names a folder for a program's files: --output.

#include <folk/tools/program/program.h>

#include <filesystem>
#include <optional>
#include <system_error>

namespace folk::tools {

/// Makes a folder and those that it lies in. At the end of the program those of them that are empty are gone again:
/// what was refused leaves nothing behind.
void make_folder(const std::filesystem::path& folder, std::error_code& error);

/// The folder of --output, on the rank that writes (launch.h); made where it is missing before anything is computed:
/// what cannot be written should not be waited for. Throws EnvironmentError when it cannot be made or written.
std::optional<std::filesystem::path> output_folder(const po::variables_map& values);

}  // namespace folk::tools
