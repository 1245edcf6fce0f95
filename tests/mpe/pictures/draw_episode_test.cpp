#include <folk/analysis/pictures/render.h>
#include <folk/games/text_file.h>
#include <folk/mpe/pictures/draw_episode.h>
#include <folk/mpe/pictures/episode_animation.h>
#include <folk/mpe/pictures/filmstrip.h>

#include <gtest/gtest.h>

#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <string>

#include "games/expect_error.h"
#include "mpe/pictures/sample_episode.h"

namespace folk::mpe {
namespace {

namespace fs = std::filesystem;
using test::expect_error;
using test::sample_episode;

/// A folder of its own that is gone afterwards.
class DrawEpisode : public testing::Test {
protected:
  DrawEpisode()
      : folder_(fs::path(testing::TempDir()) /
                (testing::UnitTest::GetInstance()->current_test_info()->name() + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
  }
  ~DrawEpisode() override { fs::remove_all(folder_); }

  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

  fs::path folder_;
};

/// With no program to be found.
void without_programs(const std::function<void()>& act) {
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", "/nowhere", 1);
  act();
  ::setenv("PATH", path.c_str(), 1);
}

/// A number of four bytes in a PNG's header, the most significant first.
double header_number(const std::string& png, std::size_t at) {
  double number = 0;
  for (std::size_t i = at; i < at + 4; ++i) number = 256 * number + static_cast<unsigned char>(png[i]);
  return number;
}

TEST_F(DrawEpisode, SvgIsTheAnimation) {
  const fs::path path = folder_ / "a.svg";
  without_programs([&] {
    require_drawable(path);
    EXPECT_EQ(files(), 0U);
    draw_episode(sample_episode(), path);
  });
  EXPECT_EQ(read_text_file(path), animated_svg(sample_episode()));
  EXPECT_EQ(files(), 1U);
}

TEST_F(DrawEpisode, PngIsTheFilmstripWhateverTheNames) {
  const fs::path path = folder_ / "it's a.png";
  EpisodeRecord record = sample_episode();
  record.predators = "exec:\"`date` <a&b>\\ 50%d @x\"";
  record.prey = "'\xff\n";
  record.rows[5].state.positions[3] = {100, 0};
  try {
    require_drawable(path);
    EXPECT_EQ(files(), 0U);
    draw_episode(record, path);
  } catch (const RendererMissing&) {
    GTEST_SKIP() << "gnuplot is not installed";
  }
  EXPECT_EQ(files(), 1U);
  const std::string png = read_text_file(path);
  EXPECT_EQ(png.substr(1, 3), "PNG");
  const Picture picture = draw_filmstrip(record);
  EXPECT_NEAR(header_number(png, 16), 2 * picture.width, 1);
  EXPECT_NEAR(header_number(png, 20), 2 * picture.height, 1);
  EXPECT_GT(png.size(), 20'000U);
}

TEST_F(DrawEpisode, PdfIsTheFilmstripToo) {
  const fs::path path = folder_ / "a.pdf";
  try {
    draw_episode(sample_episode(), path);
  } catch (const RendererMissing&) {
    GTEST_SKIP() << "gnuplot is not installed";
  }
  EXPECT_EQ(read_text_file(path).substr(1, 3), "PDF");
}

TEST_F(DrawEpisode, RefusesOtherEndings) {
  for (const char* name : {"a.gif", "a", "a.SVG", "a.PDF", "a.pdfx", ".svg", ".pdf", ""}) {
    expect_error<UsageError>([&] { require_drawable(folder_ / name); },
                             "ends in .svg (animated), .png or .pdf (a filmstrip)");
    expect_error<UsageError>([&] { draw_episode(sample_episode(), folder_ / name); }, "ends in .svg");
  }
  EXPECT_EQ(files(), 0U);
}

TEST_F(DrawEpisode, RefusesWhatCannotBeWritten) {
  fs::create_directory(folder_ / "b.svg");
  for (const auto& path : {folder_ / "missing" / "a.svg", folder_ / "b.svg"}) {
    expect_error<EnvironmentError>([&] { require_drawable(path); }, "cannot be written");
    expect_error<EnvironmentError>([&] { draw_episode(sample_episode(), path); }, path.string());
  }
  EXPECT_EQ(files(), 1U);
}

TEST_F(DrawEpisode, PngNeedsGnuplot) {
  without_programs([&] {
    expect_error<RendererMissing>([&] { require_drawable(folder_ / "a.png"); }, "apt-get install gnuplot-nox");
    expect_error<RendererMissing>([&] { draw_episode(sample_episode(), folder_ / "a.png"); }, "gnuplot-nox");
  });
  EXPECT_EQ(files(), 0U);
}

TEST_F(DrawEpisode, AFailureLeavesTheOldPicture) {
  EpisodeRecord bad = sample_episode();
  bad.rows[1].state.positions[0].x = NAN;
  for (const char* name : {"a.svg", "a.png"}) {
    write_file(folder_ / name, "old");
    expect_error<UsageError>([&] { draw_episode(bad, folder_ / name); }, "not finite");
    EXPECT_EQ(read_text_file(folder_ / name), "old");
  }
  require_drawable(folder_ / "a.svg");
  EXPECT_EQ(read_text_file(folder_ / "a.svg"), "old");
  EXPECT_EQ(files(), 2U);
}

}  // namespace
}  // namespace folk::mpe
