#include <folk/analysis/render.h>

#include <fmt/format.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <memory>
#include <optional>
#include <system_error>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;

namespace folk {
namespace {

namespace fs = std::filesystem;

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

/// An unnamed file that no child inherits but by an explicit dup2. Unlike a pipe it cannot fill up and block.
File scratch_file() {
  File file(std::tmpfile());
  if (!file) throw EnvironmentError(fmt::format("no temporary file can be made: {}", std::strerror(errno)));
  ::fcntl(::fileno(file.get()), F_SETFD, FD_CLOEXEC);
  return file;
}

/// The actions and attributes of posix_spawn, freed on every way out.
class SpawnPlan {
public:
  SpawnPlan(std::FILE* input, std::FILE* errors) {
    posix_spawn_file_actions_init(&actions_);
    posix_spawnattr_init(&attributes_);
    posix_spawn_file_actions_adddup2(&actions_, ::fileno(input), STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions_, ::fileno(errors), STDERR_FILENO);
    posix_spawn_file_actions_addopen(&actions_, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    // Folk's programs ignore SIGPIPE; what they start should not.
    sigset_t defaults;
    sigemptyset(&defaults);
    sigaddset(&defaults, SIGPIPE);
    posix_spawnattr_setsigdefault(&attributes_, &defaults);
    posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGDEF);
  }
  SpawnPlan(const SpawnPlan&) = delete;
  SpawnPlan& operator=(const SpawnPlan&) = delete;
  ~SpawnPlan() {
    posix_spawn_file_actions_destroy(&actions_);
    posix_spawnattr_destroy(&attributes_);
  }

  /// 0, or the error number of a program that could not be started.
  int start(const std::vector<std::string>& argv, pid_t& child) const {
    std::vector<char*> arguments;
    for (const auto& argument : argv) arguments.push_back(const_cast<char*>(argument.c_str()));
    arguments.push_back(nullptr);
    return posix_spawnp(&child, arguments.front(), &actions_, &attributes_, arguments.data(), environ);
  }

private:
  posix_spawn_file_actions_t actions_;
  posix_spawnattr_t attributes_;
};

std::string first_line(std::FILE* file) {
  std::rewind(file);
  char line[400];
  while (std::fgets(line, sizeof line, file) != nullptr) {
    std::string text(line);
    const auto last = text.find_last_not_of(" \t\r\n");
    if (last == std::string::npos) continue;
    text.resize(last + 1);
    return text;
  }
  return "it said nothing";
}

/// How a child ended, or nothing when it ended well.
std::optional<std::string> failure(int status) {
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return std::nullopt;
  return WIFEXITED(status) ? fmt::format("exit code {}", WEXITSTATUS(status))
                           : fmt::format("signal {}", WTERMSIG(status));
}

}  // namespace

void run_renderer(const std::vector<std::string>& argv, const std::string& input, const std::string& package) {
  const File standard_input = scratch_file();
  const File errors = scratch_file();
  if (std::fwrite(input.data(), 1, input.size(), standard_input.get()) != input.size() ||
      std::fflush(standard_input.get()) != 0)
    throw EnvironmentError(fmt::format("a temporary file cannot be written: {}", std::strerror(errno)));
  std::rewind(standard_input.get());

  const std::string& program = argv.front();
  pid_t child = 0;
  const int error = SpawnPlan(standard_input.get(), errors.get()).start(argv, child);
  if (error == ENOENT) throw RendererMissing(fmt::format("{} is not installed: apt-get install {}", program, package));
  if (error != 0) throw EnvironmentError(fmt::format("{} cannot be started: {}", program, std::strerror(error)));

  int status = 0;
  while (::waitpid(child, &status, 0) < 0)
    if (errno != EINTR) throw EnvironmentError(fmt::format("{} was lost: {}", program, std::strerror(errno)));
  if (const auto how = failure(status))
    throw EnvironmentError(fmt::format("{} failed ({}): {}", program, *how, first_line(errors.get())));
}

void draw_file(const fs::path& path, const std::function<void(const fs::path&)>& draw) {
  static std::atomic<unsigned> serial{0};
  const fs::path temporary = path.string() + fmt::format(".{}.{}.tmp", ::getpid(), serial++);
  const auto cannot = [&](const std::string& why) {
    return EnvironmentError(fmt::format("{}: cannot be written: {}", path.string(), why));
  };
  std::error_code error;
  if (fs::is_directory(path, error)) throw cannot("it is a directory");
  // An empty file first: a missing or locked folder shows as one clear line, not as another program's complaint.
  if (!std::ofstream(temporary)) throw cannot(std::strerror(errno));
  try {
    draw(temporary);
    fs::rename(temporary, path, error);
    if (error) throw cannot(error.message());
  } catch (...) {
    std::error_code ignored;
    fs::remove(temporary, ignored);
    throw;
  }
}

std::string to_string(PictureFormat format) {
  switch (format) {
    case PictureFormat::svg: return "svg";
    case PictureFormat::png: return "png";
    case PictureFormat::pdf: break;
  }
  return "pdf";
}

void render_dot(const std::string& dot, const fs::path& path, PictureFormat format) {
  draw_file(path, [&](const fs::path& temporary) {
    std::vector<std::string> argv{"dot", "-T" + to_string(format)};
    if (format == PictureFormat::png) argv.emplace_back("-Gdpi=144");
    argv.emplace_back("-o");
    argv.push_back(fs::absolute(temporary).string());
    try {
      run_renderer(argv, dot, "graphviz");
    } catch (const RendererMissing& missing) {
      throw RendererMissing(fmt::format("{}, or write a .dot file", missing.what()));
    }
  });
}

}  // namespace folk
