#pragma once
// The options that keep a training run: --checkpoint DIR and --resume.

#include <folk/tools/program/output_folder.h>
#include <folk/tools/program/program.h>

#include <fmt/format.h>
#include <folk/games/error.h>

#include <filesystem>
#include <memory>
#include <string>
#include <system_error>

namespace folk::tools {

/// Adds --checkpoint and --resume.
inline void add_checkpoint_options(po::options_description& options) {
  auto add = options.add_options();
  add("checkpoint", po::value<std::string>(), "folder for the last two checkpoints");
  add("resume", "go on from the newest checkpoint in the folder");
}

/// The folder of --checkpoint, or the one called `inside` in it, or null; its checkpoints and --resume must go
/// together. `Folder` is a sct::CheckpointFiles.
template <class Folder>
std::unique_ptr<Folder> checkpoint_folder(const po::variables_map& values, const Common& common,
                                          const std::filesystem::path& inside = {}) {
  const bool resume = values.count("resume") != 0;
  if (values.count("checkpoint") == 0) {
    if (resume) throw UsageError("--resume needs the folder of the checkpoints: give --checkpoint DIR");
    return nullptr;
  }
  const std::filesystem::path path = text_option(values, "checkpoint");
  if (path.empty()) throw UsageError("--checkpoint '': expected the name of a folder");
  std::error_code error;  // says nothing that CheckpointFiles does not
  if (!inside.empty()) make_folder(path, error);
  auto folder = std::make_unique<Folder>(inside.empty() ? path : path / inside);
  const auto found = folder->checkpoints();
  if (!found.empty() && !resume)
    throw UsageError(
        fmt::format("--checkpoint {}: it holds {} of an earlier run: give --resume to go on with it, or "
                    "name another folder",
                    excerpt(folder->path().string(), 1000), found.back().filename().string()));
  if (found.empty() && resume)
    common.note(fmt::format("no checkpoint in {} yet: beginning with step 1", excerpt(folder->path().string(), 1000)));
  return folder;
}

}  // namespace folk::tools
