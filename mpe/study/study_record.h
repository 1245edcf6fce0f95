#pragma once
// What came of a job of the study, as a small file: all tables are made of these, and one that is there is not done
// again.

#include <folk/mpe/evaluation/beliefs.h>
#include <folk/mpe/study/study_plan.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace folk::mpe {

/// A mean over episodes and its 95 % interval's half width.
struct Mean {
  double mean = 0;
  double ci95 = 0;
  bool operator==(const Mean&) const = default;
};
Mean mean_of(const Estimate& estimate);

/// How often beliefs were right (EpisodeBeliefs says what the words mean).
struct RightBeliefs {
  std::array<Mean, belief_radii.size()> right{};
  std::array<Mean, absolute_radii.size()> within{};
  Mean distance;
  bool operator==(const RightBeliefs&) const = default;
};

/// What asking for a return gave, on the episodes of the selection.
struct AskedReturn {
  double target = 0;
  Mean predators;
  std::optional<RightBeliefs> beliefs;
  bool operator==(const AskedReturn&) const = default;
};

/// What became of the play when the belief was forced; `none` on the same episodes is what it is held against.
struct ForcedBelief {
  std::string forcing;  ///< to_string(BeliefForcing)
  Mean predators;
  Mean difference;  ///< of the return from that of `none`, episode by episode
  Mean change;      ///< of an action, mean Euclidean distance
  bool operator==(const ForcedBelief&) const = default;
};

/// A report's episodes are cut into so many batches of successive ones, whose means are kept: jobs of the same seed
/// meet the same episodes, and are compared batch by batch.
inline constexpr std::size_t report_batches = 16;

/// One prey that was met. Returns are undiscounted, of one predator.
struct PreyRecord {
  std::string prey;
  Mean predators;
  std::vector<double> batches;   ///< mean returns of report_batches parts of the episodes
  std::optional<double> target;  ///< that the reported score was asked for: the best on the selection's episodes
  /// The same for the target that is best against the prey of the data, known without having met this prey.
  std::optional<double> data_target;
  std::optional<Mean> data_target_predators;
  /// The same for the policy's own target, the data's mean return, which needs no episode at all.
  std::optional<double> own_target;
  std::optional<Mean> own_target_predators;
  std::optional<RightBeliefs> beliefs;
  std::vector<AskedReturn> asked;
  std::vector<ForcedBelief> forced;
  bool operator==(const PreyRecord&) const = default;
};

struct StudyRecord {
  StudyJob job;
  std::string budget;
  std::string identity;  ///< of the settings and players that it depends on beside the job: study_identity()
  std::string folk;      ///< version that made it
  std::string diverged;  ///< why there is no policy; empty: there is one, or none was wanted
  std::string training;  ///< the run's description; empty for players
  std::uint64_t steps = 0;
  std::size_t episodes = 0;       ///< of a reported score
  double data_return = 0;         ///< mean return of the data; 0 for players
  std::string policy;             ///< 16 hexadecimal digits over the policy file's bytes; empty for players
  std::vector<PreyRecord> preys;  ///< in the order of study_preys()
  bool operator==(const StudyRecord&) const = default;
};

/// The text of a record's file, which parse_record reads back to the same record.
std::string record_text(const StudyRecord& record);

/// Throws InputFileError "source: what; mend" for what is no such text.
StudyRecord parse_record(std::string_view text, const std::string& source);

}  // namespace folk::mpe
