// Tests the conversion of drawings to PDF: size and fonts, and that a PDF's bytes do not depend on
// the time at which it is made.
#include "experiments/laboratory/figure/pdf.hpp"

#include <gtest/gtest.h>

#include "base/errors.hpp"
#include "experiments/laboratory/figure/svg_style.hpp"

namespace laboratory {
namespace {

std::string make_svg(const std::string& inside, const std::string& size = "") {
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" "
         "xmlns:xlink=\"http://www.w3.org/1999/xlink\" " +
         size + " viewBox=\"0 0 200 100\">" + inside + "</svg>";
}

bool has(const std::string& pdf, const std::string& words) {
  return pdf.find(words) != std::string::npos;
}

TEST(FigurePdf, HasTheSizeOfTheSvg) {
  // 85 mm are 240.9 points; a length without unit is in CSS pixels of 0.75 points
  EXPECT_TRUE(has(svg_to_pdf(make_svg("", "width=\"85mm\" height=\"50pt\""), "x"),
                  "/MediaBox [ 0 0 240.94488"));
  EXPECT_TRUE(has(svg_to_pdf(make_svg(""), "x"), "/MediaBox [ 0 0 150 75 ]"));
}

TEST(FigurePdf, EmbedsFontsAndHasNoDate) {
  const auto svg =
      make_svg("<g font-family=\"DejaVu Serif, serif\"><text x=\"5\" y=\"9\">30 µs</text></g>");
  const auto pdf = svg_to_pdf(svg, "x");
  EXPECT_TRUE(has(pdf, "+DejaVuSerif"));
  EXPECT_TRUE(has(pdf, "/FontFile2"));
  EXPECT_FALSE(has(pdf, "Date"));
  EXPECT_EQ(pdf, svg_to_pdf(svg, "x"));
  EXPECT_NE(pdf, svg_to_pdf(make_svg("<text x=\"5\" y=\"9\">40 µs</text>"), "x"));
}

TEST(FigurePdf, FollowsReferencesAndRefusesWhatItCannotDraw) {
  const auto drawn = [](const std::string& inside) { return svg_to_pdf(make_svg(inside), "x"); };
  const std::string symbol = "<defs><circle id='s' r='2'/></defs>";
  EXPECT_NE(drawn(symbol + "<use xlink:href='#s' x='9'/>"), drawn(symbol));
  for (const auto* inside : {"<use xlink:href='#t'/>", "<image/>", "<path d='M0 0A1 1 0 0 0 5 5'/>",
                             "<rect fill='mauve'/>", "<g transform='skewX(3)'/>"})
    EXPECT_THROW(drawn(inside), base::InvariantBroken) << inside;
  EXPECT_THROW(drawn("<g>"), base::BadInput);
}

TEST(FigurePdf, ReadsNumbersColoursAndTransformations) {
  EXPECT_EQ(read_numbers("1,-2.5 3e1px.5"), (std::vector<double>{1, -2.5, 30, 0.5}));
  EXPECT_EQ(read_numbers("1-2-3"), (std::vector<double>{1, -2, -3}));
  const SvgColour red{1, 0, 0};
  EXPECT_EQ(read_colour("rgb( 255,  0, 0)", {}), red);
  EXPECT_EQ(read_colour("#f00", {}), red);
  EXPECT_EQ(read_colour("currentColor", red), red);
  EXPECT_FALSE(read_colour("none", red));
  EXPECT_EQ(read_transform("translate(4, 8) scale(2)"), (SvgMatrix{2, 0, 0, 2, 4, 8}));
  const auto turned = read_transform("rotate(90 1 0)");  // maps (0, 0) to (1, -1)
  EXPECT_NEAR(turned[4], 1, 1e-12);
  EXPECT_NEAR(turned[5], -1, 1e-12);
}

TEST(FigurePdf, AppliesTheLastTransformationOfAListFirst) {
  const auto twice = read_transform("rotate(25) rotate(65)"), once = read_transform("rotate(90)");
  for (std::size_t i = 0; i < once.size(); ++i) EXPECT_NEAR(twice[i], once[i], 1e-12) << i;
  const auto moved = read_transform("rotate(90) translate(4, 8)");  // maps (0, 0) to (-8, 4)
  EXPECT_NEAR(moved[4], -8, 1e-12);
  EXPECT_NEAR(moved[5], 4, 1e-12);
}

}  // namespace
}  // namespace laboratory
