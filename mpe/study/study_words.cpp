#include <folk/mpe/study/study_words.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace folk::mpe {
namespace {

using Titles = std::pair<std::string_view, std::string_view>;

template <std::size_t size>
std::string title_of(const std::array<Titles, size>& titles, std::string_view word) {
  const auto found = std::find_if(titles.begin(), titles.end(), [&](const Titles& one) { return one.first == word; });
  return std::string(found == titles.end() ? word : found->second);
}

}  // namespace

std::string learner_title(std::string_view learner) {
  static constexpr std::array titles{Titles{"omar", "OMAR"},
                                     Titles{"bc", "BC"},
                                     Titles{"ma-bcq", "MA-BCQ"},
                                     Titles{"madt", "MADT"},
                                     Titles{"rmadt", "RMADT"},
                                     Titles{"sct", "SCT"},
                                     Titles{"sct-selfconf", "SCT, paper's loss"},
                                     Titles{"matd3", "MATD3 (made the data)"},
                                     Titles{"lead_pursuit", "pursuit rule"},
                                     Titles{"random_play", "random play"}};
  return title_of(titles, learner);
}

std::string prey_title(std::string_view prey) {
  static constexpr std::array titles{Titles{"random(program)", "random"}, Titles{"blend(0.5)", "blend 0.5"}};
  return title_of(titles, prey);
}

std::string forcing_title(std::string_view forcing) {
  // The words are those of to_string(BeliefForcing).
  static const std::array titles{Titles{to_string(BeliefForcing::none), "its own"},
                                 Titles{to_string(BeliefForcing::truth), "the truth"},
                                 Titles{to_string(BeliefForcing::other_episode), "of another episode"},
                                 Titles{to_string(BeliefForcing::zero), "no action"}};
  return title_of(titles, forcing);
}

std::string file_prefix(const StudyTables& tables) { return tables.data_prey == "released" ? "" : "trained_prey_"; }

std::string fixed(double value, int decimals) {
  std::string text = fmt::format("{:.{}f}", value, decimals);
  if (text.starts_with('-') && text.find_first_of("123456789") == std::string::npos && std::isfinite(value))
    text.erase(0, 1);
  return text;
}

double paper_ci95(double sd) {
  constexpr double runs = 100;
  constexpr double quantile = 1.9842169515864;  // Student's t, 99 degrees of freedom, 0.975
  return quantile * sd / std::sqrt(runs);
}

std::optional<ToPaper> to_paper(const ScoreRow& row) {
  if (!row.score || !row.paper || row.prey == "maddpg") return std::nullopt;
  const double difference = row.score->mean - *row.paper;
  if (std::abs(difference) <= row.score->ci95 + paper_ci95(row.paper_sd.value_or(0))) return ToPaper::alike;
  return difference > 0 ? ToPaper::above : ToPaper::below;
}

std::optional<Cell> within_inferred(const AccuracyRow& row) {
  return inferred_radius < row.within.size() ? row.within[inferred_radius] : std::nullopt;
}

}  // namespace folk::mpe
