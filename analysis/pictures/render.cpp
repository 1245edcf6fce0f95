#include <folk/analysis/pictures/render.h>
#include <folk/games/file_descriptor.h>
#include <folk/games/text_file.h>
#include <folk/strategies/programs/keeper.h>
#include <folk/strategies/programs/pipes.h>
#include <folk/strategies/programs/spawn.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <optional>
#include <sstream>
#include <string_view>
#include <system_error>
#include <utility>

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
  if (const auto error = write_all(file, text))
    throw EnvironmentError(fmt::format("a temporary file cannot be written: {}", error.message()));
  ::lseek(file.get(), 0, SEEK_SET);
  return file;
}

/// What comes through a pipe until its other end is closed.
std::string all_of(const FileDescriptor& pipe) {
  std::string text;
  std::array<char, 65536> block;
  for (;;) {
    const ssize_t count = ::read(pipe.get(), block.data(), block.size());
    if (count > 0)
      text.append(block.data(), static_cast<std::size_t>(count));
    else if (count == 0 || errno != EINTR)
      return text;
  }
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

std::string run_renderer(const std::vector<std::string>& argv, const std::string& input, const std::string& package) {
  const FileDescriptor standard_input = scratch_file_with(input);
  const FileDescriptor errors = scratch_file();

  const std::string& program = argv.front();
  pid_t child = 0;
  std::optional<Kept> kept;
  FileDescriptor drawn;
  try {
    Pipe output = open_pipe();
    const auto error =
        spawn(child, argv, {standard_input.get(), output.write_end.get(), errors.get()}, ProcessGroup::ours);
    if (error == std::errc::no_such_file_or_directory)
      throw RendererMissing(fmt::format("{} is not installed: apt-get install {}", program, package));
    if (error) throw std::system_error(error);
    kept.emplace(child);
    drawn = std::move(output.read_end);
  } catch (const std::system_error& error) {
    throw EnvironmentError(fmt::format("{} cannot be started: {}", program, error.code().message()));
  }

  const std::string picture = all_of(drawn);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0)
    if (errno != EINTR) throw EnvironmentError(fmt::format("{} was lost: {}", program, reason(errno)));
  if (const auto how = failure(status))
    throw EnvironmentError(fmt::format("{} failed ({}): {}", program, *how, complaint(program, errors)));
  return picture;
}

namespace {

std::string run_dot(const std::vector<std::string>& argv, const std::string& dot) {
  try {
    return run_renderer(argv, dot, "graphviz");
  } catch (const RendererMissing& missing) {
    throw RendererMissing(fmt::format("{}, or write a .dot file", missing.what()));
  }
}

}  // namespace

std::string to_string(PictureFormat format) {
  switch (format) {
    case PictureFormat::svg: return "svg";
    case PictureFormat::png: return "png";
    case PictureFormat::pdf: break;
  }
  return "pdf";
}

std::string plain_layout(const std::string& dot) { return run_dot({"dot", "-Tplain"}, dot); }

void render_dot(const std::string& dot, const fs::path& path, PictureFormat format, Places places) {
  require_writable(path);
  std::vector<std::string> argv{"dot", "-T" + to_string(format)};
  if (format == PictureFormat::png) argv.emplace_back("-Gdpi=144");
  if (places == Places::given) argv.insert(argv.end(), {"-Kneato", "-n2"});
  write_file(path, run_dot(argv, dot));
}

}  // namespace folk
