#include <folk/analysis/pictures/render.h>
#include <folk/games/text_file.h>

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

namespace folk {
namespace {

namespace fs = std::filesystem;

/// A folder of its own that is gone afterwards.
class Render : public testing::Test {
protected:
  Render()
      : folder_(testing::TempDir() + "folk_render_" + testing::UnitTest::GetInstance()->current_test_info()->name()) {
    fs::remove_all(folder_);
    fs::create_directory(folder_);
  }
  ~Render() override { fs::remove_all(folder_); }

  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

  fs::path folder_;
};

template <class Exception, class Act>
std::string message_of(Act&& act) {
  try {
    act();
  } catch (const Exception& error) {
    return error.what();
  }
  return "nothing was thrown";
}

TEST_F(Render, InputReachesTheProgram) {
  const std::string large(1 << 20, 'x');  // more than a pipe holds
  EXPECT_EQ(run_renderer({"cat"}, large, "coreutils"), large);
}

TEST_F(Render, ArgumentsPassNoShell) {
  run_renderer({"touch", (folder_ / "a b;$HOME'\"").string()}, "", "coreutils");
  EXPECT_TRUE(fs::exists(folder_ / "a b;$HOME'\""));
}

TEST_F(Render, AMissingProgramNamesItsPackage) {
  EXPECT_EQ(message_of<RendererMissing>([] { run_renderer({"folk-no-such-program"}, "", "no-such-package"); }),
            "folk-no-such-program is not installed: apt-get install no-such-package");
}

TEST_F(Render, AFailureIsOneLine) {
  EXPECT_EQ(message_of<EnvironmentError>([] {
              run_renderer({"sh", "-c", "echo; echo why >&2; echo more >&2; exit 3"}, "", "dash");
            }),
            "sh failed (exit code 3): why");
  EXPECT_EQ(message_of<EnvironmentError>([] {
              run_renderer({"sh", "-c", "kill -9 $$"}, "", "dash");
            }),
            "sh failed (signal 9): it said nothing");
}

/// A folder of stand-ins in front of PATH for a while.
class FirstOnPath {
public:
  explicit FirstOnPath(const fs::path& folder)
      : path_(std::getenv("PATH")) {
    ::setenv("PATH", (folder.string() + ":" + path_).c_str(), 1);
  }
  ~FirstOnPath() { ::setenv("PATH", path_.c_str(), 1); }
  FirstOnPath(const FirstOnPath&) = delete;
  FirstOnPath& operator=(const FirstOnPath&) = delete;

private:
  std::string path_;
};

TEST_F(Render, AFailureShowsTheLineThatSaysWhy) {
  const FirstOnPath here(folder_);
  const auto failing = [&](const std::string& program, const std::string& says) {
    write_file(folder_ / program, "#!/bin/sh\ncat >&2 <<'END'\n" + says + "END\nexit 1\n");
    fs::permissions(folder_ / program, fs::perms::owner_all);
    return message_of<EnvironmentError>([&] { run_renderer({program}, "", "package"); });
  };
  // The first two are what gnuplot 5.4 and Graphviz 2.43 wrote.
  EXPECT_EQ(failing("gnuplot", "\ngnuplot> foo bar\n         ^\n         line 0: invalid command\n\n"),
            "gnuplot failed (exit code 1): line 0: invalid command");
  EXPECT_EQ(failing("dot",
                    "Warning: using box for unknown shape xx\nWarning: node c, port q unrecognized\n"
                    "Error: Could not open \"none/x\" for writing : No such file or directory\n"
                    "Error: <stdin>: syntax error in line 1 near '}'\n"),
            "dot failed (exit code 1): Error: Could not open \"none/x\" for writing : No such file or directory");
  EXPECT_EQ(failing("dot", "There is no layout engine support for \"dot\"\nPerhaps ...\n"),
            "dot failed (exit code 1): There is no layout engine support for \"dot\"");
  EXPECT_EQ(failing("dot", std::string(5000, 'x') + "\n"), "dot failed (exit code 1): " + std::string(400, 'x'));
}

TEST_F(Render, AFailedDrawingLeavesTheOldFileAndNothingElse) {
  if (std::system("dot -V >/dev/null 2>&1") != 0) GTEST_SKIP() << "Graphviz is not installed";
  const fs::path path = folder_ / "picture.svg";
  write_file(path, "old");
  EXPECT_THROW(render_dot("digraph {", path, PictureFormat::svg), EnvironmentError);
  EXPECT_EQ(read_text_file(path), "old");
  EXPECT_EQ(files(), 1U);
}

// As texts are: a link stays one, what is a pipe is written to, permissions are kept.
TEST_F(Render, PicturesAreWrittenAsTextsAre) {
  if (std::system("dot -V >/dev/null 2>&1") != 0) GTEST_SKIP() << "Graphviz is not installed";
  fs::create_symlink("real.svg", folder_ / "link.svg");  // it dangles
  render_dot("digraph {}", folder_ / "link.svg", PictureFormat::svg);
  EXPECT_TRUE(fs::is_symlink(folder_ / "link.svg"));
  fs::permissions(folder_ / "real.svg", fs::perms::owner_read | fs::perms::owner_write);
  render_dot("digraph {a}", folder_ / "link.svg", PictureFormat::svg);
  EXPECT_NE(read_text_file(folder_ / "real.svg").find("</svg>"), std::string::npos);
  EXPECT_EQ(fs::status(folder_ / "real.svg").permissions(), fs::perms::owner_read | fs::perms::owner_write);
  if (fs::exists("/dev/full")) {
    EXPECT_EQ(message_of<EnvironmentError>([] { render_dot("digraph {}", "/dev/full", PictureFormat::pdf); }),
              "/dev/full: cannot be written: No space left on device");
  }
  EXPECT_EQ(files(), 2U);
}

TEST_F(Render, PlacesThatCannotBeWrittenAreNamed) {
  const std::string missing = (folder_ / "none" / "a.svg").string();
  EXPECT_EQ(message_of<EnvironmentError>([&] { render_dot("", missing, PictureFormat::svg); }),
            missing + ": cannot be written: there is no such folder; make it or name another");
  EXPECT_EQ(message_of<EnvironmentError>([&] { render_dot("", folder_, PictureFormat::svg); }),
            folder_.string() + ": cannot be written: it is a directory; name a file in it");
}

TEST_F(Render, DotWritesEveryFormat) {
  if (std::system("dot -V >/dev/null 2>&1") != 0) GTEST_SKIP() << "Graphviz is not installed";
  const std::string dot = "digraph \"g\" { a -> b [label=\"…\"]; }";
  render_dot(dot, folder_ / "g.svg", PictureFormat::svg);
  render_dot(dot, folder_ / "g.png", PictureFormat::png);
  render_dot(dot, folder_ / "g.pdf", PictureFormat::pdf);
  EXPECT_NE(read_text_file(folder_ / "g.svg").find("<svg"), std::string::npos);
  EXPECT_EQ(read_text_file(folder_ / "g.png").substr(1, 3), "PNG");
  EXPECT_EQ(read_text_file(folder_ / "g.pdf").substr(0, 4), "%PDF");
  EXPECT_EQ(files(), 3U);
}

TEST_F(Render, ABrokenGraphIsOneLine) {
  if (std::system("dot -V >/dev/null 2>&1") != 0) GTEST_SKIP() << "Graphviz is not installed";
  const std::string message =
      message_of<EnvironmentError>([&] { render_dot("digraph {", folder_ / "g.svg", PictureFormat::svg); });
  EXPECT_EQ(message.rfind("dot failed (exit code ", 0), 0U) << message;
  EXPECT_EQ(files(), 0U);
}

TEST_F(Render, WithoutDotTheWayOutIsNamed) {
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", folder_.c_str(), 1);
  const std::string message =
      message_of<RendererMissing>([&] { render_dot("digraph {}", folder_ / "g.svg", PictureFormat::svg); });
  ::setenv("PATH", path.c_str(), 1);
  EXPECT_EQ(message, "dot is not installed: apt-get install graphviz, or write a .dot file");
  EXPECT_EQ(files(), 0U);
}

}  // namespace
}  // namespace folk
