#include <folk/mpe/pictures/svg_shapes.h>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <string>

#include "mpe/pictures/xml_check.h"

namespace folk::mpe {
namespace {

using test::XmlCheck;

TEST(XmlCheck, KnowsWhatIsWellFormed) {
  EXPECT_EQ(XmlCheck::fault("<a b=\"1\" c=\"&lt;\"><d/>x &amp; y</a>\n"), "");
  for (const char* bad : {"", "<a>", "<a></b>", "<a/><b/>", "x<a/>", "<a>&</a>", "<a>></a>", "<a b=1/>",
                          "<a b=\"1\" b=\"2\"/>", "<a b=\"<\"/>", "<a>\xff</a>", "<a>\x01</a>", "</a>", "<a"})
    EXPECT_NE(XmlCheck::fault(bad), "") << bad;
}

TEST(SvgShapes, NumbersAreShort) {
  EXPECT_EQ(svg_number(12.34567), "12.3");
  EXPECT_EQ(svg_number(12.0), "12");
  EXPECT_EQ(svg_number(-0.04), "0");
  EXPECT_EQ(svg_path_data({{1, 2}, {3.25, -4}}), "M1 2 3.3 -4");
}

TEST(SvgShapes, TextIsEscaped) {
  EXPECT_EQ(xml_text("exec:\"a<b&c>\""), "exec:&quot;a&lt;b&amp;c&gt;&quot;");
  EXPECT_EQ(xml_text("it's"), "it's");
  EXPECT_EQ(xml_text("a\nb\x01"
                     "c\xff"
                     "d\xEF\xBF\xBF"),
            "a b c?d?");
  EXPECT_EQ(xml_text("Füchse"), "Füchse");
}

TEST(SvgShapes, LongTextLosesItsMiddle) {
  EXPECT_EQ(printable("abcdefghij", 10), "abcdefghij");
  EXPECT_EQ(printable("abcdefghijk", 10), "abcde…hijk");
  EXPECT_EQ(printable("ääääääääääö", 5), "ää…äö");
  EXPECT_EQ(printable("it's 'so'", 20), "it's 'so'");
}

TEST(SvgShapes, EachShapeIsAnElement) {
  const Paint red{"#ff0000", 0.5};
  EXPECT_EQ(svg_elements({Circle{{1, 2}, 3, red, {}, 1}}),
            "<circle cx=\"1\" cy=\"2\" r=\"3\" fill=\"#ff0000\" fill-opacity=\"0.5\"/>\n");
  Path box = rectangle({0, 0}, 2, 1);
  box.line = Paint{"#0000ff"};
  EXPECT_EQ(svg_elements({box}),
            "<path d=\"M0 0 2 0 2 1 0 1z\" fill=\"none\" stroke=\"#0000ff\" stroke-width=\"1\" "
            "stroke-linejoin=\"round\"/>\n");
  EXPECT_EQ(svg_elements({Text{{5, 10}, "a<b", 10, Text::Anchor::middle, true}}),
            "<text x=\"5\" y=\"13.6\" font-size=\"10\" fill=\"#222222\" text-anchor=\"middle\" "
            "font-weight=\"bold\">a&lt;b</text>\n");
}

RC_GTEST_PROP(SvgShapes, AnyTextMakesAWellFormedDocument, (const std::string& text)) {
  const std::string document = svg_document(10, 10, text, svg_elements({Text{{1, 1}, text}}));
  RC_ASSERT(XmlCheck::fault(document).empty());
}

}  // namespace
}  // namespace folk::mpe
