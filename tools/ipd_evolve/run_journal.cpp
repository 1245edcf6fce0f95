#include <folk/tools/ipd_evolve/run_journal.h>
#include <folk/tools/program/interruption.h>
#include <folk/tools/program/launch.h>
#include <folk/tools/program/progress.h>

#include <fmt/format.h>
#include <folk/analysis/evolution/evolution_journal.h>
#include <folk/games/error.h>

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace folk::tools {

Journal journal_option(const po::variables_map& values) {
  return Journal(values.count("journal") != 0 ? std::optional<std::filesystem::path>(text_option(values, "journal"))
                                              : std::nullopt);
}

void run_with_journal(Evolution& evolution, std::uint64_t generations, Journal& journal, std::uint64_t identity,
                      std::size_t strategies, const Common& common) {
  // What rank 0 has read, all go on from; a letter before it says that there is one.
  const auto found = journal.read();
  if (const std::string told = crew().tell(found ? "j" + *found : ""); !told.empty()) {
    const auto text = std::string_view(told).substr(1);
    evolution.restore(read_evolution_journal(text, journal.name(), identity, strategies));
    if (evolution.state().generation > generations)
      throw UsageError(
          fmt::format("--journal {}: it is at generation {}, beyond --generations {}: ask for more, or "
                      "name another file",
                      journal.name(), evolution.state().generation, generations));
    common.note(fmt::format("going on from generation {} of {}", evolution.state().generation, journal.name()));
  }
  const auto text = [&] { return journal_text(evolution.state(), identity); };
  try {
    ProgressBar bar("evolving", !common.quiet);
    const Interruption interruption;
    evolution.run(generations, {std::ref(bar), Interruption::requested}, [&] { journal.now_and_then(text); });
  } catch (const Cancelled&) {
    if (journal) journal.write(text());
    end_interrupted(bool(journal), fmt::format("generation {}", evolution.state().generation));
  }
  if (journal) journal.write(text());
}

}  // namespace folk::tools
