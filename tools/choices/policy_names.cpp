#include <folk/tools/choices/policy_names.h>

#include <folk/tools/program/data_folder.h>

#include <fmt/format.h>
#include <folk/games/error.h>
#include <folk/sct/policy/policy_file.h>
#include <folk/strategies/quoted_text.h>

#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <utility>

namespace folk::tools {
namespace {

namespace fs = std::filesystem;

Strategy policy_strategy(const std::string& name, const fs::path& file, const sct::PlayOptions& options) {
  return sct::transformer(name, read_mind(file), options);
}

fs::path shipped_file(const std::string& name) { return data_folder() / "policies" / (name + ".bin"); }

void add_shipped(Registry& registry, const std::string& name, std::string behaviour, const sct::PlayOptions& options) {
  registry.add({name, {}, std::move(behaviour), "Li, Guevara, Xie & Zhu, arXiv 2310.04579; docs/sct-train.md"},
               [name, options](const std::string&, std::string_view, const Payoffs&) {
                 const fs::path file = shipped_file(name);
                 std::error_code error;
                 if (!fs::exists(file, error))
                   throw InputFileError(
                       fmt::format("{}: there is no {}; install Folk's data, say in FOLK_DATA where it is, or train a "
                                   "policy with sct-train and name it sct:FILE",
                                   name, excerpt(file.string(), 1000)));
                 return policy_strategy(name, file, options);
               });
}

}  // namespace

std::shared_ptr<const sct::Mind> read_mind(const fs::path& file) {
  auto policy = sct::read_policy(file);
  try {
    return std::make_shared<const sct::Mind>(std::move(policy));
  } catch (const UsageError& error) {  // a sound file of a network for something else
    throw InputFileError(fmt::format("{}: {}", excerpt(file.string(), 1000), error.what()));
  }
}

std::optional<fs::path> policy_file(std::string_view name) {
  constexpr std::string_view prefix = "sct:";
  if (name.starts_with(prefix)) return unquoted(name.substr(prefix.size()));
  for (const std::string shipped : {"sct", "sct-bayes", "sct-plan"})
    if (same_name(name, shipped)) return shipped_file(shipped);
  return std::nullopt;
}

namespace {

/// "FILE;depth=H", or FILE alone: as deep as the policy says, where it says so.
Strategy planning(std::string_view arguments, const sct::PlayOptions& options) {
  auto [file, last] = split_last_argument(arguments);
  sct::PlayOptions planned = options;
  if (last) {
    const auto depth = value_of_option(*last, "depth");
    if (!depth)
      throw UsageError(
          fmt::format("sct-plan({}): expected FILE;depth=H, as in sct-plan(policy.bin;depth=4)", excerpt(arguments)));
    planned.plan_depth = static_cast<unsigned>(parse_whole_number(*depth, "sct-plan depth", 1, sct::most_plan_depth));
  }
  const std::string path = unquoted(trimmed(file));
  if (path.empty()) throw UsageError("sct-plan needs the name of a policy's file, as in sct-plan(policy.bin;depth=4)");
  const auto mind = read_mind(path);
  if (!planned.plan_depth) {
    const unsigned own = mind->policy.training.plan_depth;
    planned.plan_depth = own > 0 ? own : sct::default_plan_depth;
  }
  return sct::transformer(fmt::format("sct-plan({};depth={})", path, *planned.plan_depth), mind, planned);
}

}  // namespace

void add_policies(Registry& registry, const sct::PlayOptions& options) {
  add_shipped(registry, "sct",
              "self-confirming transformer, trained on the round robin of sct2025: believes, then acts", options);
  add_shipped(registry, "sct-bayes", "the same network, trained on Bayes-optimal play against sct2025", options);
  add_shipped(registry, "sct-plan", "plays the best reply, 6 rounds ahead, to what it has learnt to believe", options);
  registry.add({"sct-plan(FILE;depth=H)",
                {},
                "a policy of sct-train that plays the best reply, H rounds ahead, to what it believes",
                "Li, Guevara, Xie & Zhu, arXiv 2310.04579, Definition 2; docs/sct.md"},
               [options](const std::string&, std::string_view arguments, const Payoffs&) {
                 return planning(arguments, options);
               });
  registry.add_prefix({"sct:FILE", {}, "a policy that sct-train wrote", "docs/sct-train.md"},
                      "sct:", [options](std::string_view item, const Payoffs&) {
                        const std::string file = unquoted(item);
                        if (file.empty()) throw UsageError("'sct:' needs the name of a file, as in sct:policy.bin");
                        return std::vector<Strategy>{policy_strategy("sct:" + file, file, options)};
                      });
}

}  // namespace folk::tools
