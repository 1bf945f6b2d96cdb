// Histograms with fixed bins.
#include "simulator/observe/histogram.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace observe {
namespace {

std::vector<Passage> take(const std::vector<double>& latencies_s) {
  std::vector<Passage> passages;
  for (const double latency_s : latencies_s) passages.push_back({0, latency_s});
  return passages;
}

TEST(Histogram, LatenciesHaveTwentyBinsADecade) {
  const auto histogram = make_latency_histogram(take({1.12e-4, 1.13e-4, 2e-4, 1.1e-3}));
  // from 112 us to below 1.12 ms: one decade, and the bin of the last value is its last
  ASSERT_EQ(histogram.bins.size(), 20u);
  EXPECT_EQ(histogram.bins[0].low, 1.12e-4) << "the bound is the nearest number to 0.000112";
  EXPECT_EQ(histogram.bins[0].high, 1.25e-4);
  EXPECT_EQ(histogram.bins[0].count, 2u) << "a lower bound belongs to its bin";
  EXPECT_EQ(histogram.bins[5].low, 2e-4);
  EXPECT_EQ(histogram.bins[5].count, 1u);
  EXPECT_EQ(histogram.bins[19].low, 1e-3);
  for (std::size_t i = 1; i < histogram.bins.size(); ++i) {
    const auto& bin = histogram.bins[i];
    EXPECT_EQ(bin.low, histogram.bins[i - 1].high);
    EXPECT_NEAR(std::log10(bin.high / bin.low), 0.05, 0.008) << "preferred numbers are rounded";
  }
}

TEST(Histogram, TheOuterBinsContainWhatIsBeyond) {
  const auto histogram = make_latency_histogram(take({0, 1e7}));
  EXPECT_EQ(histogram.bins.front().low, 1e-9);
  EXPECT_EQ(histogram.bins.back().high, 1e6);
  EXPECT_EQ(histogram.bins.size(), 15u * 20);
  EXPECT_EQ(histogram.bins.front().count, 1u);
  EXPECT_EQ(histogram.bins.back().count, 1u);
  EXPECT_TRUE(make_latency_histogram({}).bins.empty());
}

TEST(Histogram, LoadsHaveTwentyEqualBins) {
  const auto histogram = make_link_histogram({0, 0.049, 0.05, 0.15, 1});
  ASSERT_EQ(histogram.bins.size(), 20u);
  EXPECT_EQ(histogram.bins[0].count, 2u);
  EXPECT_EQ(histogram.bins[1].count, 1u);
  EXPECT_EQ(histogram.bins[3].count, 1u);
  EXPECT_EQ(histogram.bins[19].count, 1u) << "a link that is always busy";
}

TEST(Histogram, RowsHaveShares) {
  const auto rows = make_rows(make_link_histogram({0, 0, 0, 1}));
  ASSERT_EQ(rows.size(), 20u);
  EXPECT_EQ(rows[0][5], (std::pair<std::string, base::Cell>("share", 0.75)));
  EXPECT_EQ(rows[1][5].second, base::Cell(0.0)) << "empty bins between others have rows";
  EXPECT_TRUE(make_rows(make_link_histogram({})).empty());
}

}  // namespace
}  // namespace observe
