#pragma once
// Histograms with fixed bins, so that those of different runs can be compared and added.
#include <cstdint>
#include <string>
#include <vector>

#include "base/fields.hpp"
#include "simulator/observe/latencies.hpp"

namespace observe {

constexpr auto LATENCY_HISTOGRAM = "latency_s", LINK_HISTOGRAM = "link_load";

struct Histogram {
  /// The values v with low <= v < high. The last bin of loads also contains its upper bound.
  struct Bin {
    double low, high;
    std::uint64_t count;
  };
  std::string quantity;   ///< name of the values, with their unit: "latency_s"
  std::string of;         ///< what is counted: "messages"
  std::vector<Bin> bins;  ///< adjacent and ascending
};

/// Counts the latencies of messages. A decade has 20 bins. Their bounds are the preferred numbers
/// R20 of ISO 3, from 1 ns to 10^6 s; the first and the last bin also contain what is beyond. Omits
/// empty bins before the first message and after the last.
Histogram make_latency_histogram(const std::vector<Passage>& passages);

/// Counts the loads of link directions, 0 to 1, in 20 bins of equal width.
Histogram make_link_histogram(const std::vector<double>& loads);

/// Rows of histogram.csv: quantity, of, low, high, count, and the share of all that are counted.
/// Empty if nothing is counted.
std::vector<base::Row> make_rows(const Histogram& histogram);

}  // namespace observe
