#pragma once
// The names of trained policies: sct, sct-bayes, sct-plan and sct:FILE.

#include <folk/sct/policy/sct_player.h>
#include <folk/strategies/registry.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string_view>

namespace folk::tools {

/// Adds the two shipped policies and the prefix for any other. The file is read when the name is made to a strategy;
/// that throws InputFileError. Shipped ones lie in policies/ of the folder that the environment's FOLK_DATA names, else
/// of the installation's or the source tree's data.
void add_policies(Registry& registry, const sct::PlayOptions& options);

/// The file that a policy's name stands for: of sct, sct-bayes, sct-plan or sct:FILE. Nothing for any other name.
std::optional<std::filesystem::path> policy_file(std::string_view name);

/// Reads a policy and makes it ready to play. Throws InputFileError.
std::shared_ptr<const sct::Mind> read_mind(const std::filesystem::path& file);

}  // namespace folk::tools
