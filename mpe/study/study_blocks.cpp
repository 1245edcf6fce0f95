#include <folk/mpe/study/study_blocks.h>
#include <folk/mpe/study/study_words.h>

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>

namespace folk::mpe {
namespace {

constexpr std::string_view no_data = "none";

template <class Row>
const std::optional<Cell>& main_cell(const Row& row) {
  return row.score;
}
const std::optional<Cell>& main_cell(const AccuracyRow& row) { return row.accuracy; }
const std::optional<Cell>& main_cell(const PairedRow& row) { return row.difference; }

bool plays_only(const std::string& learner) {
  const auto& players = study_players();
  return std::find(players.begin(), players.end(), learner) != players.end();
}

/// The place of what fits in a list, at whose end it is put where nothing fits.
template <class Item, class Fits>
std::size_t place_of(std::vector<Item>& items, Item&& item, Fits&& fits) {
  const auto found = std::find_if(items.begin(), items.end(), fits);
  if (found != items.end()) return static_cast<std::size_t>(found - items.begin());
  items.push_back(std::move(item));
  return items.size() - 1;
}

template <class Row>
using Words = std::function<std::string(const Row&)>;

template <class Row>
void put(StudyBlock<Row>& block, const Row& row, const std::string& line, const std::string& column) {
  const std::size_t l = place_of(block.lines, {line, {}}, [&](const auto& one) { return one.learner == line; });
  block.lines[l].cells.resize(block.columns.size(), nullptr);
  const auto found = std::find(block.columns.begin(), block.columns.end(), column);
  block.lines[l].cells[static_cast<std::size_t>(found - block.columns.begin())] = &row;
}

template <class Row>
std::vector<StudyBlock<Row>> blocks_of(const std::vector<const Row*>& rows, const Words<Row>& line,
                                       const Words<Row>& column) {
  std::map<std::string, std::vector<std::string>> columns;  // of a scenario
  for (const Row* row : rows)
    place_of(columns[row->scenario], column(*row), [&](const std::string& one) { return one == column(*row); });
  std::vector<StudyBlock<Row>> blocks;
  for (const Row* row : rows) {
    if (row->level == no_data) continue;
    const std::size_t b =
        place_of(blocks, {row->scenario, row->level, columns[row->scenario], {}},
                 [&](const auto& one) { return one.scenario == row->scenario && one.level == row->level; });
    put(blocks[b], *row, line(*row), column(*row));
  }
  for (const Row* row : rows)
    for (auto& block : blocks)
      if (row->level == no_data && block.scenario == row->scenario) put(block, *row, line(*row), column(*row));
  std::stable_sort(blocks.begin(), blocks.end(), [](const auto& a, const auto& b) { return a.scenario < b.scenario; });
  return blocks;
}

/// Pointers to all rows, those of learners first.
template <class Row>
std::vector<const Row*> learners_first(const std::vector<Row>& rows, const std::vector<Row>& more = {}) {
  std::vector<const Row*> pointers;
  for (const auto* part : {&rows, &more})
    for (const auto& row : *part) pointers.push_back(&row);
  std::stable_partition(pointers.begin(), pointers.end(), [](const Row* row) { return !plays_only(row->learner); });
  return pointers;
}

template <class Row>
std::string learner_of(const Row& row) {
  return row.learner;
}

template <class Row>
std::string prey_of(const Row& row) {
  return row.prey;
}

template <class Row>
std::string learner_and_prey(const Row& row) {
  return row.learner + ", " + row.prey;
}

}  // namespace

template <class Row>
bool StudyBlock<Row>::begun() const {
  return std::any_of(lines.begin(), lines.end(), [](const Line& line) {
    return std::any_of(line.cells.begin(), line.cells.end(),
                       [](const Row* row) { return row != nullptr && main_cell(*row).has_value(); });
  });
}

template struct StudyBlock<ScoreRow>;
template struct StudyBlock<BlendRow>;
template struct StudyBlock<AccuracyRow>;
template struct StudyBlock<PairedRow>;
template struct StudyBlock<AskedRow>;
template struct StudyBlock<ForcedRow>;

std::vector<StudyBlock<ScoreRow>> score_blocks(const StudyTables& tables) {
  return blocks_of<ScoreRow>(learners_first(tables.scores, tables.players), learner_of<ScoreRow>, prey_of<ScoreRow>);
}

std::vector<StudyBlock<BlendRow>> blend_blocks(const StudyTables& tables) {
  return blocks_of<BlendRow>(learners_first(tables.blends), learner_of<BlendRow>,
                             [](const BlendRow& row) { return fmt::format("{}", row.p); });
}

std::vector<StudyBlock<AccuracyRow>> accuracy_blocks(const StudyTables& tables) {
  return blocks_of<AccuracyRow>(learners_first(tables.accuracies), learner_of<AccuracyRow>, prey_of<AccuracyRow>);
}

std::vector<StudyBlock<PairedRow>> paired_blocks(const StudyTables& tables) {
  return blocks_of<PairedRow>(
      learners_first(tables.paired), [](const PairedRow& row) { return "SCT minus " + learner_title(row.learner); },
      prey_of<PairedRow>);
}

std::vector<StudyBlock<AskedRow>> asked_blocks(const StudyTables& tables) {
  return blocks_of<AskedRow>(learners_first(tables.asked), learner_and_prey<AskedRow>,
                             [](const AskedRow& row) { return fmt::format("{}", row.target); });
}

std::vector<StudyBlock<ForcedRow>> forced_blocks(const StudyTables& tables) {
  return blocks_of<ForcedRow>(learners_first(tables.forced), learner_and_prey<ForcedRow>,
                              [](const ForcedRow& row) { return row.forcing; });
}

std::vector<StudyPlace> study_places(const StudyTables& tables) {
  std::vector<StudyPlace> places;
  for (const auto& row : tables.blends) {
    const bool known = std::any_of(places.begin(), places.end(), [&](const StudyPlace& place) {
      return place.scenario == row.scenario && place.level == row.level && place.learner == row.learner;
    });
    if (known) continue;
    const auto found = tables.data_prey_returns.find(fmt::format("{}-{}-{}", row.scenario, row.level, row.learner));
    places.push_back(
        {row.scenario, row.level, row.learner, found == tables.data_prey_returns.end() ? 0 : found->second.seeds});
  }
  return places;
}

}  // namespace folk::mpe
