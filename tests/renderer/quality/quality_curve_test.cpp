// Tests curves of picture quality by comparison with values calculated by hand.
#include "renderer/quality/quality_curve.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/errors.hpp"
#include "tests/support/files.hpp"

namespace renderer {
namespace {

using Points = std::vector<QualityPoint>;

TEST(QualityCurve, ByHand) {
  const Points points{{1, 10, 100, 0.5}, {2, 30, 500, 0.9}, {5, 40, 1000, 1}};
  const QualityFigures time = eval_quality_curve(points);
  EXPECT_DOUBLE_EQ(time.area, (0.5 * 1 + 0.9 * 3) / 5);
  EXPECT_EQ(time.to_50, 1);
  EXPECT_EQ(time.to_90, 2);
  EXPECT_EQ(time.to_99, 5);
  const QualityFigures rays = eval_quality_curve(points, &QualityPoint::rays);
  EXPECT_DOUBLE_EQ(rays.area, (0.5 * 20 + 0.9 * 10) / 40);
  EXPECT_EQ(rays.to_90, 30);
  const QualityFigures work = eval_quality_curve(points, &QualityPoint::work);
  EXPECT_DOUBLE_EQ(work.area, (0.5 * 400 + 0.9 * 500) / 1000);
  EXPECT_EQ(work.to_50, 100);
}

TEST(QualityCurve, WhatIsLostAgainDoesNotCount) {
  const QualityFigures found =
      eval_quality_curve(Points{{1, 0, 0, 0.95}, {2, 0, 0, 0.4}, {3, 0, 0, 0.6}, {4, 0, 0, 1}});
  EXPECT_DOUBLE_EQ(found.area, (0.95 + 0.4 + 0.6) / 4);
  EXPECT_EQ(found.to_50, 3);
  EXPECT_EQ(found.to_90, 4);
}

TEST(QualityCurve, SharesAreOfTheLastQuality) {
  const QualityFigures found =
      eval_quality_curve(Points{{0, 0, 0, 0.2}, {1, 0, 0, 0.45}, {2, 0, 0, 0.5}});
  EXPECT_EQ(found.to_50, 1);
  EXPECT_EQ(found.to_90, 1);
  EXPECT_EQ(found.to_99, 2);
  EXPECT_DOUBLE_EQ(found.area, 0.325);
}

TEST(QualityCurve, OfOnePoint) {
  const QualityFigures later = eval_quality_curve(Points{{3, 0, 0, 1}}),
                       at_once = eval_quality_curve(Points{{0, 0, 0, 1}});
  EXPECT_EQ(later.area, 0);
  EXPECT_EQ(later.to_50, 3);
  EXPECT_EQ(at_once.area, 1);
  EXPECT_EQ(at_once.to_99, 0);
}

TEST(QualityCurve, PointsBeforeTheFirstDoNotCount) {
  const Points points{{1, 0, 0, 0.1}, {2, 0, 0, 1}, {3, 0, 0, 1}};
  EXPECT_EQ(eval_quality_curve(std::span(points).subspan(2)).to_50, 3);
}

std::string complaint(const Points& points) {
  return ::test::message_of<base::BadInput>([&] { eval_quality_curve(points); });
}

TEST(QualityCurve, NamesWhatIsWrong) {
  EXPECT_EQ(complaint({}), "growth: found no point, expected 1 or more");
  EXPECT_EQ(complaint({{2, 0, 0, 1}, {1, 0, 0, 1}}),
            "growth, point 1: found 1, expected a number, 2 or more");
  EXPECT_EQ(complaint({{-1, 0, 0, 1}}), "growth, point 0: found -1, expected a number, 0 or more");
  EXPECT_EQ(complaint({{1, 0, 0, std::nan("")}}),
            "growth, point 0: found nan, expected a quality, a number");
  EXPECT_EQ(complaint({{1, 0, 0, 0}}), "growth, last point: found 0, expected a quality above 0");
}

}  // namespace
}  // namespace renderer
