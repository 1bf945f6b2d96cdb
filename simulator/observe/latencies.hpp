#pragma once
// Distribution of the times that messages spend in a network.
#include <optional>
#include <vector>

#include "base/fields.hpp"

namespace observe {

/// Percentiles of the latencies of messages in seconds (nearest rank), and how far the mean still
/// changes during the measurement. All values are empty if there are no messages.
struct Latencies {
  std::optional<double> p50_s = {}, p95_s = {}, p99_s = {}, longest_s = {};
  /// Mean of the second half of the measured messages over that of the first half, minus 1.
  std::optional<double> drift = {};
};

/// A message that was measured: when it was sent, and how long it took. Both in seconds.
struct Passage {
  double sent_s, latency_s;
};

/// Evaluates messages that were sent between two dates. The drift compares the two halves of this
/// period.
Latencies eval_latencies(const std::vector<Passage>& passages, double from_s, double to_s);

/// A sentence that asks for a longer measurement if the mean latency still changes by more than
/// 10 %; else "".
std::string describe_drift(const Latencies& latencies);

/// Columns for a program whose results have a member `latencies`.
base::Columns<Latencies> latency_columns();

}  // namespace observe
