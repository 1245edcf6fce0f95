#include <folk/analysis/pictures/gnuplot_script.h>

#include <gtest/gtest.h>

#include "games/has.h"

namespace folk::gnuplot {
namespace {

using folk::test::has;

TEST(TextWidth, NoCharacterIsWiderThanSaid) {
  // The widest fonts in use, in thousandths of their size: DejaVu Sans (its hmtx table), and Arial where that is wider.
  struct Letter {
    const char* text;
    double advance;
  };
  for (const auto& [text, advance] :
       {Letter{"W", 989}, {"m", 974}, {"w", 818}, {"M", 863}, {"@", 1015}, {"%", 950},  {"O", 787},
        {"Q", 787},       {"&", 780}, {"N", 748}, {"H", 752}, {"G", 775},  {"D", 770},  {"U", 732},
        {"=", 838},       {"#", 838}, {"~", 838}, {"A", 684}, {"0", 636},  {"_", 556},  {"b", 635},
        {"i", 278},       {"t", 392}, {"(", 390}, {"!", 401}, {"r", 411},  {"\"", 460}, {"-", 361},
        {".", 318},       {"J", 500}, {"f", 352}, {"é", 615}, {"Щ", 1076}, {"…", 1000}, {"日", 1000}})
    EXPECT_GE(text_width(text, 1000), advance) << text;
}

TEST(TextWidth, NamesOfWideLettersHaveTheirRoom) {
  const std::string wide(40, 'W');
  EXPECT_GE(widest_name({"a", wide}, 12), 31 * 12 * 0.989 + 12);
  EXPECT_LT(widest_name({"a", wide}, 12), 33 * 12);  // of 40 characters 32 are drawn
  EXPECT_LT(text_width("tit_for_tat", 12), 0.63 * 12 * 11);
}

TEST(Fitted, TheMiddleGivesWay) {
  EXPECT_EQ(fitted("short", 12, 100), "short");
  const std::string shown = fitted(std::string(50, 'a') + std::string(50, 'z'), 12, 100);
  EXPECT_LE(text_width(shown, 12), 100);
  EXPECT_TRUE(shown.starts_with("aa") && shown.ends_with("zz") && has(shown, "…")) << shown;
  EXPECT_EQ(fitted("anything", 12, 0), "…");
}

TEST(XmlText, IsNoMarkup) { EXPECT_EQ(xml_text("<a> & \"b\" ]]>\n\xff"), "&lt;a&gt; &amp; &quot;b&quot; ]]&gt; ?"); }

TEST(WithWords, MakesRoomForTitleAndCaption) {
  Layout layout;
  layout.width = 100;
  layout.height = 50;
  const Caption caption{std::string(60, 'g'), "finite:100", 0};
  const Layout framed = with_words(layout, "A title that is much wider than the picture", caption);
  EXPECT_GT(framed.height, layout.height + 2 * 14);  // two lines at least
  EXPECT_GE(framed.width, text_width(caption.game, note_font));
  const std::string script = opening(PictureFormat::svg, framed, "It's", caption);
  EXPECT_TRUE(has(script, "set label 'It''s' at "));
  EXPECT_TRUE(has(script, "set label '" + caption.game));
  EXPECT_TRUE(has(script, "Folk "));
}

TEST(WithWords, AVeryLongTitleLosesItsMiddle) {
  Layout layout;
  layout.width = 100;
  layout.height = 50;
  const std::string title = std::string(150, 'a') + std::string(150, 'z');
  const Layout framed = with_words(layout, title, {});
  EXPECT_LT(framed.width, 1000);
  const std::string script = opening(PictureFormat::svg, framed, title, {});
  EXPECT_TRUE(has(script, "aa…zz"));
  EXPECT_FALSE(has(script, title));
}

}  // namespace
}  // namespace folk::gnuplot
