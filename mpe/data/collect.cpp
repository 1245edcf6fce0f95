#include <folk/games/error.h>
#include <folk/games/text_file.h>
#include <folk/mpe/data/collect.h>
#include <folk/mpe/data/data_figures.h>
#include <folk/mpe/data/data_set.h>
#include <folk/mpe/data/data_writer.h>
#include <folk/mpe/data/episode_rows.h>
#include <folk/mpe/data/partial_folder.h>
#include <folk/mpe/evaluation/episodes.h>

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <system_error>
#include <utility>

namespace folk::mpe {

namespace fs = std::filesystem;

namespace {

constexpr const char* description_name = "description.json";
constexpr double playing = 0.9;  // its share of the work; the rest reads what was written

class Collecting {
public:
  Collecting(const Layout& layout, const Cast& cast, const DataDescription& description, const CollectRules& rules,
             const Progress& progress)
      : layout_(layout),
        cast_(cast),
        description_(description),
        rules_(rules),
        progress_(progress) {}

  Collection into(const fs::path& folder);

private:
  Collection what_is_there(const fs::path& folder) const;
  bool goes_on(const PartialFolder& partial) const;
  void work(PartialFolder& partial, bool resumes);
  void play_missing(DataWriter& writer, const std::vector<bool>& there);
  void play(DataWriter& writer, std::size_t begin, std::size_t end);
  void require_same_play(std::size_t episode, std::uint64_t signature) const;
  void finish(PartialFolder& partial, DataWriter& writer);

  EpisodePlan plan(std::size_t begin, std::size_t end) const {
    return {description_.seed, description_.first_episode + begin, end - begin, rules_.threads};
  }
  DataSetRules data_rules() const { return {description_.scenario, true, rules_.threads}; }

  const Layout& layout_;
  const Cast& cast_;
  const DataDescription& description_;
  const CollectRules& rules_;
  const Progress& progress_;
  Collection collection_;
};

bool is_there(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(fs::symlink_status(path, ignored));
}

Collection Collecting::into(const fs::path& folder) {
  if (is_there(folder)) return what_is_there(folder);
  PartialFolder partial(folder);
  if (is_there(folder)) {  // another run has just ended
    partial.remove();
    return what_is_there(folder);
  }
  const bool resumes = goes_on(partial);
  try {
    work(partial, resumes);
  } catch (const Cancelled&) {
    throw CollectionCancelled(collection_.written);
  } catch (...) {
    if (!resumes) partial.remove();
    throw;
  }
  return collection_;
}

Collection Collecting::what_is_there(const fs::path& folder) const {
  const std::string name = excerpt(folder.string(), 1000);
  if (!rules_.resume)
    throw UsageError(fmt::format("{}: it is there already; name another folder, or move it away", name));
  const DataSet data = DataSet::open(folder, data_rules());
  if (!data.record())
    throw UsageError(fmt::format("{}: a data set without a record of Folk is there; name another folder", name));
  if (const auto other = difference(description_text(data.record()->description), description_))
    throw UsageError(fmt::format("{}: another data set is there: {}; name another folder", name, *other));
  require_recorded(data, data_figures(data, rules_.threads));
  require_same_play(0, episode_signature(data.episode_bytes(0)));
  Collection collection{Collection::End::was_there, data.episodes(), data.episodes(), *data.record()};
  return collection;
}

/// Whether there is something of this very data set to go on with.
bool Collecting::goes_on(const PartialFolder& partial) const {
  const fs::path path = partial.path() / description_name;
  if (!rules_.resume || !is_there(path)) return false;
  if (const auto other = difference(read_text_file(path), description_))
    throw UsageError(fmt::format("{}: an unfinished data set of another kind: {}; leave --resume out to begin anew",
                                 excerpt(partial.path().string(), 1000), *other));
  return true;
}

void Collecting::work(PartialFolder& partial, bool resumes) {
  if (!resumes) partial.clear();
  DataWriter writer(partial.path(), layout_.scenario(), description_.type, description_.episodes);
  // It comes last: where it is, the files have their full size.
  if (!resumes) write_file(partial.path() / description_name, description_text(description_));
  std::vector<bool> there(description_.episodes, false);
  if (resumes) there = writer.written(rules_.threads);
  const auto first = std::find(there.begin(), there.end(), true);
  if (first != there.end()) {
    const auto episode = static_cast<std::size_t>(first - there.begin());
    require_same_play(episode, writer.signature(episode));
  }
  collection_.kept = static_cast<std::size_t>(std::count(there.begin(), there.end(), true));
  collection_.written = collection_.kept;
  play_missing(writer, there);
  finish(partial, writer);
}

void Collecting::play_missing(DataWriter& writer, const std::vector<bool>& there) {
  for (std::size_t begin = 0; begin < there.size();) {
    std::size_t end = begin;
    while (end < there.size() && !there[end]) ++end;
    if (end > begin) play(writer, begin, end);
    begin = end + 1;
  }
}

void Collecting::play(DataWriter& writer, std::size_t begin, std::size_t end) {
  const auto all = static_cast<double>(description_.episodes);
  const std::size_t before = collection_.written;
  std::atomic<std::size_t> written{before};
  const auto watcher = [&](std::size_t i) {
    return std::make_unique<EpisodeRows>(layout_, description_.type,
                                         [&, first = begin + i](const RowBytes& rows, std::size_t episodes) {
                                           writer.write(first, rows);
                                           written += episodes;
                                         });
  };
  const auto share = [&](std::size_t episodes) { return playing * static_cast<double>(episodes) / all; };
  try {
    play_episodes(layout_, cast_, plan(begin, end), watcher,
                  progress_.part(share(before), share(before + end - begin)));
  } catch (...) {
    collection_.written = written;
    throw;
  }
  collection_.written = written;
}

/// The players may be files or programs that have changed since.
void Collecting::require_same_play(std::size_t episode, std::uint64_t signature) const {
  std::uint64_t now = 0;
  play_episodes(layout_, cast_, plan(episode, episode + 1), [&](std::size_t) {
    return std::make_unique<EpisodeRows>(layout_, description_.type, [&](const RowBytes& rows, std::size_t) {
      const std::vector<std::string_view> parts(rows.begin(), rows.end());
      now = episode_signature(parts);
    });
  });
  if (now != signature)
    throw UsageError(
        fmt::format("episode {} is played otherwise now than when this data set was begun: a player has changed; leave "
                    "--resume out and begin anew",
                    description_.first_episode + episode));
}

void Collecting::finish(PartialFolder& partial, DataWriter& writer) {
  writer.finish();
  std::error_code ignored;
  DataRecord record{description_, {}};
  {
    const DataSet data = DataSet::open(partial.path(), data_rules());
    progress_((1 + playing) / 2);
    record.figures = data_figures(data, rules_.threads, progress_.part((1 + playing) / 2, 1));
  }
  writer.remove_journal();
  write_file(partial.path() / metadata_name, metadata_text(record));
  fs::remove(partial.path() / description_name, ignored);
  partial.publish();
  progress_(1);
  collection_.record = std::move(record);
}

}  // namespace

Collection collect(const Layout& layout, const Cast& cast, const DataDescription& description, const fs::path& folder,
                   const CollectRules& rules, const Progress& progress) {
  const auto& scenario = layout.scenario();
  if (description.scenario != scenario.name || description.reward_rule != scenario.rewards.rule ||
      description.episode_steps != scenario.episode_steps || description.episodes == 0)
    throw UsageError("a description of another scenario, or of no episodes");
  return Collecting(layout, cast, description, rules, progress).into(folder);
}

}  // namespace folk::mpe
