#include <folk/tools/program/launch.h>

#include <fmt/format.h>
#include <folk/analysis/crew/ranks.h>
#include <folk/analysis/crew/transport.h>
#include <folk/analysis/play/signature.h>
#include <folk/games/error.h>
#include <folk/tools/program/interruption.h>

#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string_view>
#include <system_error>

#include <dlfcn.h>

namespace folk::tools {
namespace {

namespace fs = std::filesystem;

/// The first of these variables that is a whole number.
std::optional<std::size_t> number_of(std::initializer_list<const char*> names) {
  for (const char* name : names) {
    const char* const text = std::getenv(name);
    if (text == nullptr) continue;
    const std::string_view digits(text);
    std::size_t number = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    if (error == std::errc() && end == digits.data() + digits.size() && !digits.empty()) return number;
  }
  return std::nullopt;
}

/// How many ranks there are, and which this is. Slurm tells a batch script the number of tasks that its srun would
/// start: it counts only where srun has also made this process one of them.
Launch ranks_of_environment() {
  if (const auto ranks = number_of({"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"}))
    if (const auto rank = number_of({"OMPI_COMM_WORLD_RANK", "PMI_RANK"})) return {*rank, *ranks};
  if (const auto rank = number_of({"PMIX_RANK", "PMI_RANK"}))
    if (const auto ranks = number_of({"SLURM_STEP_NUM_TASKS"})) return {*rank, *ranks};
  return {};
}

struct State {
  Launch launch{};
  std::unique_ptr<Ranks> ranks{};
  OneProcess alone{};
};

State& state() {
  static State the_state;
  return the_state;
}

fs::path component() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  return (program.parent_path() / FOLK_MPI_FROM_PROGRAM).lexically_normal();
}

/// The component's Transport. It stays loaded: MPI leaves threads and handlers behind.
std::unique_ptr<Transport> transport() {
  const fs::path file = component();
  const std::size_t ranks = state().launch.ranks;
  if (std::error_code error; !fs::exists(file, error))
    throw EnvironmentError(
        fmt::format("a launcher started {} ranks of this, but Folk's component for MPI is not installed ({}): build "
                    "with -DFOLK_MPI=ON, run one process, or set FOLK_MPI=off to run each by itself",
                    ranks, file.string()));
  void* const library = ::dlopen(file.c_str(), RTLD_NOW | RTLD_GLOBAL);
  if (library == nullptr)
    throw EnvironmentError(fmt::format("Folk's component for MPI cannot be loaded: {}", ::dlerror()));
  using Maker = Transport* (*)(const char**);
  const auto maker = reinterpret_cast<Maker>(::dlsym(library, "folk_mpi_transport_1"));
  if (maker == nullptr)
    throw EnvironmentError(fmt::format("{} is the component of another Folk: install both again", file.string()));
  const char* error = "it does not say why";
  std::unique_ptr<Transport> made(maker(&error));
  if (!made) throw EnvironmentError(fmt::format("MPI does not start: {}", error));
  if (made->ranks() != ranks)
    throw EnvironmentError(
        fmt::format("the launcher speaks of {} ranks and MPI of {}: start this with the mpirun of the MPI that Folk is "
                    "built with",
                    ranks, made->ranks()));
  return made;
}

}  // namespace

Launch launch_of_environment() {
  if (const char* choice = std::getenv("FOLK_MPI"); choice != nullptr && std::string_view(choice) == "off") return {};
  Launch launch = ranks_of_environment();
  if (launch.ranks < 2 || launch.rank >= launch.ranks) return {};
  launch.rank_here =
      number_of({"OMPI_COMM_WORLD_LOCAL_RANK", "MPI_LOCALRANKID", "SLURM_LOCALID"}).value_or(launch.rank);
  launch.ranks_here = number_of({"OMPI_COMM_WORLD_LOCAL_SIZE", "MPI_LOCALNRANKS"}).value_or(1);
  return launch;
}

void share_work() { state().launch = launch_of_environment(); }

bool speaks() { return state().launch.rank == 0; }

std::size_t ranks_here() { return state().launch.ranks_here; }

void join_ranks(const std::string& command) {
  if (state().launch.ranks < 2) return;
  try {
    state().ranks = std::make_unique<Ranks>(transport());
  } catch (...) {
    // It may be missing on one machine alone: the first rank there says so, when it is not all that say it.
    if (state().launch.rank_here == 0) state().launch.rank = 0;
    throw;
  }
  Signature signature;
  signature.add(command);
  const Interruption interruption;
  try {
    state().ranks->agree(signature.value(), {[](double) {}, Interruption::requested});
  } catch (const UsageError& error) {
    throw UsageError(fmt::format("{}; FOLK_MPI=off in the environment leaves each to itself", error.what()));
  }
}

Crew& crew() {
  if (state().ranks) return *state().ranks;
  return state().alone;
}

int leave_ranks(int code, const std::exception_ptr& failure) {
  if (!state().ranks) return code;
  const bool first = state().ranks->first();
  state().ranks->leave(failure);
  state().ranks.reset();
  return first ? code : 0;
}

}  // namespace folk::tools
