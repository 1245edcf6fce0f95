#include <folk/analysis/pictures/render.h>
#include <folk/strategies/programs/file_descriptor.h>
#include <folk/strategies/programs/spawn.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <fstream>
#include <optional>
#include <sstream>
#include <string_view>
#include <system_error>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

namespace folk {
namespace {

namespace fs = std::filesystem;

/// What is shown of one line of a program's standard error, in bytes.
constexpr std::size_t longest_complaint = 400;

std::string reason(int error) { return std::generic_category().message(error); }

/// An unnamed file in memory, close-on-exec. Unlike a pipe it cannot fill up and block.
FileDescriptor scratch_file() {
  FileDescriptor file(::memfd_create("folk-render", MFD_CLOEXEC));
  if (file.get() < 0) throw EnvironmentError(fmt::format("no temporary file can be made: {}", reason(errno)));
  return file;
}

/// A scratch file that is read from its beginning.
FileDescriptor scratch_file_with(std::string_view text) {
  FileDescriptor file = scratch_file();
  while (!text.empty()) {
    const ssize_t written = ::write(file.get(), text.data(), text.size());
    if (written >= 0)
      text.remove_prefix(static_cast<std::size_t>(written));
    else if (errno != EINTR)
      throw EnvironmentError(fmt::format("a temporary file cannot be written: {}", reason(errno)));
  }
  ::lseek(file.get(), 0, SEEK_SET);
  return file;
}

/// The lines of a scratch file that are not blank, without the blanks around them.
std::vector<std::string> lines_of(const FileDescriptor& file) {
  std::string text;
  std::array<char, 4096> block;
  const auto read_on = [&] { return ::pread(file.get(), block.data(), block.size(), static_cast<off_t>(text.size())); };
  for (ssize_t count = read_on(); count > 0; count = read_on())
    text.append(block.data(), static_cast<std::size_t>(count));
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) {
    const auto first = line.find_first_not_of(" \t\r");
    if (first == std::string::npos) continue;
    const auto last = line.find_last_not_of(" \t\r");
    lines.push_back(line.substr(first, std::min(last + 1 - first, longest_complaint)));
  }
  return lines;
}

/// The line of a program's standard error that says why it failed. gnuplot repeats the command, points at the place,
/// and says why in the last line; others say it first, dot perhaps after warnings.
std::string complaint(const std::string& program, const FileDescriptor& errors) {
  const auto lines = lines_of(errors);
  if (lines.empty()) return "it said nothing";
  if (program == "gnuplot") return lines.back();
  const auto error =
      std::find_if(lines.begin(), lines.end(), [](const auto& line) { return line.rfind("Error", 0) == 0; });
  return error != lines.end() ? *error : lines.front();
}

/// How a child ended, or nothing when it ended well.
std::optional<std::string> failure(int status) {
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return std::nullopt;
  return WIFEXITED(status) ? fmt::format("exit code {}", WEXITSTATUS(status))
                           : fmt::format("signal {}", WTERMSIG(status));
}

}  // namespace

void run_renderer(const std::vector<std::string>& argv, const std::string& input, const std::string& package) {
  const FileDescriptor standard_input = scratch_file_with(input);
  const FileDescriptor dropped(::open("/dev/null", O_WRONLY | O_CLOEXEC));
  if (dropped.get() < 0) throw EnvironmentError(fmt::format("/dev/null cannot be opened: {}", reason(errno)));
  const FileDescriptor errors = scratch_file();

  const std::string& program = argv.front();
  pid_t child = 0;
  const auto error = spawn(child, argv, {standard_input.get(), dropped.get(), errors.get()}, ProcessGroup::ours);
  if (error == std::errc::no_such_file_or_directory)
    throw RendererMissing(fmt::format("{} is not installed: apt-get install {}", program, package));
  if (error) throw EnvironmentError(fmt::format("{} cannot be started: {}", program, error.message()));

  int status = 0;
  while (::waitpid(child, &status, 0) < 0)
    if (errno != EINTR) throw EnvironmentError(fmt::format("{} was lost: {}", program, reason(errno)));
  if (const auto how = failure(status))
    throw EnvironmentError(fmt::format("{} failed ({}): {}", program, *how, complaint(program, errors)));
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
  if (!std::ofstream(temporary)) throw cannot(reason(errno));
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
