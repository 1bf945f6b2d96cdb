#include "simulator/observe/latencies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "simulator/observe/mean.hpp"

namespace observe {

namespace {

constexpr double LARGE_DRIFT = 0.1;

std::optional<double> eval_drift(const std::vector<Passage>& passages, double middle_s) {
  double sums[2] = {}, counts[2] = {};
  for (const auto& passage : passages) {
    const bool is_late = passage.sent_s >= middle_s;
    sums[is_late] += passage.latency_s;
    ++counts[is_late];
  }
  const auto early = eval_mean(sums[0], counts[0]), late = eval_mean(sums[1], counts[1]);
  if (!early || !late) return std::nullopt;
  return *late / *early - 1;
}

}  // namespace

Latencies eval_latencies(const std::vector<Passage>& passages, double from_s, double to_s) {
  if (passages.empty()) return {};
  std::vector<double> ascending;
  for (const auto& passage : passages) ascending.push_back(passage.latency_s);
  std::ranges::sort(ascending);
  const auto count = static_cast<double>(ascending.size());
  const auto at = [&](double share) {
    return ascending[static_cast<std::size_t>(std::ceil(share * count)) - 1];
  };
  return {at(0.5), at(0.95), at(0.99), at(1), eval_drift(passages, (from_s + to_s) / 2)};
}

std::string describe_drift(const Latencies& latencies) {
  if (!latencies.drift || std::abs(*latencies.drift) <= LARGE_DRIFT) return "";
  return fmt::format(
      "the mean latency changed by {:+.0f} % between the halves of the measurement: expected a "
      "longer warm-up and window",
      100 * *latencies.drift);
}

base::Columns<Latencies> latency_columns() {
  using L = Latencies;
  return {
      base::column("latency_p50_s", &L::p50_s, "median of the times of the same messages"),
      base::column("latency_p95_s", &L::p95_s, "time that 95 % of these messages do not exceed"),
      base::column("latency_p99_s", &L::p99_s, "time that 99 % of these messages do not exceed"),
      base::column("latency_max_s", &L::longest_s, "longest time of these messages"),
      base::column("latency_drift", &L::drift,
                   "mean time of messages sent in the second half of the measurement over that "
                   "of the first half, minus 1")};
}

}  // namespace observe
