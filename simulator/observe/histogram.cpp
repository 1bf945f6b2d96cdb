#include "simulator/observe/histogram.hpp"

#include <algorithm>

namespace observe {

namespace {

// The bounds of bins of latencies in seconds.
const std::vector<double>& latency_bounds() {
  constexpr int R20[] = {100, 112, 125, 140, 160, 180, 200, 224, 250, 280,
                         315, 355, 400, 450, 500, 560, 630, 710, 800, 900};
  static const auto all = [&] {
    std::vector<double> bounds;
    // dividing or multiplying two whole numbers rounds once
    for (double divisor = 1e11; divisor >= 1; divisor /= 10)
      for (const int number : R20) bounds.push_back(number / divisor);
    for (double factor = 10; factor <= 1e3; factor *= 10)
      for (const int number : R20) bounds.push_back(number * factor);
    bounds.push_back(1e6);
    return bounds;
  }();
  return all;
}

std::vector<Histogram::Bin> count_values(const std::vector<double>& bounds,
                                         const std::vector<double>& values) {
  std::vector<Histogram::Bin> bins;
  for (std::size_t i = 0; i + 1 < bounds.size(); ++i) bins.push_back({bounds[i], bounds[i + 1], 0});
  for (const double value : values) {
    const auto above = std::ranges::upper_bound(bounds, value) - bounds.begin();
    const auto last = static_cast<std::ptrdiff_t>(bins.size()) - 1;
    ++bins[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(above - 1, 0, last))].count;
  }
  return bins;
}

void remove_empty_ends(std::vector<Histogram::Bin>& bins) {
  const auto is_used = [](const Histogram::Bin& bin) { return bin.count > 0; };
  bins.erase(std::find_if(bins.rbegin(), bins.rend(), is_used).base(), bins.end());
  bins.erase(bins.begin(), std::ranges::find_if(bins, is_used));
}

}  // namespace

Histogram make_latency_histogram(const std::vector<Passage>& passages) {
  std::vector<double> latencies;
  for (const auto& passage : passages) latencies.push_back(passage.latency_s);
  Histogram histogram{LATENCY_HISTOGRAM, "messages", count_values(latency_bounds(), latencies)};
  remove_empty_ends(histogram.bins);
  return histogram;
}

Histogram make_link_histogram(const std::vector<double>& loads) {
  constexpr int BINS = 20;
  std::vector<double> bounds;
  for (int i = 0; i <= BINS; ++i) bounds.push_back(i / double{BINS});
  return {LINK_HISTOGRAM, "link directions", count_values(bounds, loads)};
}

std::vector<base::Row> make_rows(const Histogram& histogram) {
  double all = 0;
  for (const auto& bin : histogram.bins) all += static_cast<double>(bin.count);
  std::vector<base::Row> rows;
  if (all == 0) return rows;
  for (const auto& [low, high, count] : histogram.bins)
    rows.push_back({{"quantity", histogram.quantity},
                    {"of", histogram.of},
                    {"low", low},
                    {"high", high},
                    {"count", static_cast<std::int64_t>(count)},
                    {"share", static_cast<double>(count) / all}});
  return rows;
}

}  // namespace observe
