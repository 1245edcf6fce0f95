#pragma once
// Where the data that Folk ships lies.

#include <filesystem>

namespace folk::tools {

/// The folder that the environment's FOLK_DATA names, else the data of this program's installation or source tree:
/// policies/ holds transformers, mpe/ the players of the particle world.
std::filesystem::path data_folder();

/// From now on data_folder() is this one, unless the environment names another: a module is no program that could look
/// beside itself.
void use_data_folder(std::filesystem::path folder);

}  // namespace folk::tools
