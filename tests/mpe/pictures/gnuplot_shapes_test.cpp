#include <folk/mpe/pictures/gnuplot_shapes.h>

#include <gtest/gtest.h>

#include <string>

#include "games/expect_error.h"
#include "mpe/pictures/sample_episode.h"

namespace folk::mpe {
namespace {

using test::count;

std::string script(std::vector<Shape> shapes) {
  return gnuplot_script({200, 100, std::move(shapes)}, PictureFormat::png);
}

TEST(GnuplotShapes, TheAxesAreThePicturesPixels) {
  const std::string text = script({Circle{{1, 2}, 3, Paint{"#ff0000"}, {}, 1}});
  EXPECT_EQ(count(text, "set xrange [0:200]\nset yrange [100:0]\n"), 1U);
  EXPECT_EQ(count(text, "size 400,200 "), 1U);  // two pixels for one
}

TEST(GnuplotShapes, EachShapeIsDrawnInItsOrder) {
  const std::string text =
      script({Circle{{1, 2}, 3, Paint{"#ff0000", 0.5}, Paint{"#00ff00"}, 2},
              Path{{{1, 1}, {2, 2.5}}, false, {}, Paint{"#0000ff"}, 1.5}, rectangle({0, 0}, 5, 5)});
  EXPECT_EQ(count(text, "$S0 << END_OF_DATA\n1.00 2.00 3.00\nEND_OF_DATA\n"), 1U);
  EXPECT_EQ(count(text, "$S1 << END_OF_DATA\n1.00 1.00\n2.00 2.50\nEND_OF_DATA\n"), 1U);
  const std::string plot =
      "plot $S0 with circles fc rgb '#80ff0000' fs solid noborder, \\\n"
      "     $S0 with circles lc rgb '#0000ff00' lw 2 fs empty border, \\\n"
      "     $S1 with lines lc rgb '#000000ff' lw 1.5\n";
  EXPECT_EQ(count(text, plot), 1U) << text;
}

TEST(GnuplotShapes, AClosedPathReturnsToItsBeginning) {
  Path box = rectangle({0, 0}, 2, 1);
  box.fill = Paint{"#ffffff"};
  const std::string text = script({box});
  EXPECT_EQ(count(text, "\n0.00 0.00\n2.00 0.00\n2.00 1.00\n0.00 1.00\n0.00 0.00\nEND_OF_DATA"), 1U);
  EXPECT_EQ(count(text, "plot $S0 with filledcurves closed fc rgb '#00ffffff' fs solid noborder\n"), 1U);
}

TEST(GnuplotShapes, TextIsNoCode) {
  const std::string text = script({rectangle({0, 0}, 5, 5), Text{{5, 6}, "it's `date` @x\n", 9, Text::Anchor::middle}});
  EXPECT_EQ(count(text,
                  "set label 'it''s `date` @x ' at first 5.00,6.00 center front font ',9' textcolor rgb "
                  "'#222222'\n"),
            1U)
      << text;
}

}  // namespace
}  // namespace folk::mpe
