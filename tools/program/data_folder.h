#pragma once
// Where the data that Folk ships lies.

#include <filesystem>

namespace folk::tools {

/// The folder that the environment's FOLK_DATA names, else the data of this program's installation or source tree:
/// policies/ holds transformers, mpe/ the players of the particle world.
std::filesystem::path data_folder();

}  // namespace folk::tools
