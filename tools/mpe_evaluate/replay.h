#pragma once
// Recorded episodes played again: mpe-evaluate --replay.

#include <folk/tools/program/program.h>

#include <folk/games/progress.h>
#include <folk/mpe/evaluation/replay.h>

#include <cstdint>
#include <ostream>
#include <string>
#include <vector>

namespace folk::tools {

struct ReplaySettings {
  std::vector<std::string> files;
  mpe::ReplayMode mode = mpe::ReplayMode::one_step;
  mpe::RewardRule rewards = mpe::RewardRule::program;
  double tolerance = 1e-12;
};

struct ReplayedEpisode {
  std::uint64_t number = 0;
  mpe::ReplayResult result;
};

struct ReplayedFile {
  std::string file;
  std::string scenario;
  std::vector<ReplayedEpisode> episodes;
};

/// Replays every file; what deviates most comes last. Throws InputFileError.
std::vector<ReplayedFile> replay_files(const ReplaySettings& settings, const Progress& progress);

/// True when nothing deviates by more than the tolerance.
bool within(const ReplaySettings& settings, const std::vector<ReplayedFile>& files);

/// A row a file in text, a row an episode in CSV, one object in JSON.
void write_replay(std::ostream& out, Format format, const ReplaySettings& settings,
                  const std::vector<ReplayedFile>& files);

}  // namespace folk::tools
