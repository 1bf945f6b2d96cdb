#pragma once
// History of a live run, for pages that open late or miss frames.
#include <nlohmann/json.hpp>

#include <deque>
#include <mutex>
#include <vector>

namespace laboratory {

/// Values of the growth curves over simulated time, and the user's actions. The size is bounded.
/// The samples are numbered. Keeps the first sample, the last one, and all samples whose number is
/// a multiple of `stride`. The stride is 1 at first, and doubles whenever more than MOST_SAMPLES
/// samples are kept. Keeps only the latest MOST_ACTIONS actions. Any thread may call the functions.
class History {
 public:
  static constexpr std::size_t MOST_SAMPLES = 2000, MOST_ACTIONS = 1000;

  /// The part of the history that a page has: the numbers of its last sample and action.
  struct Place {
    std::uint64_t samples = 0, actions = 0;
  };

  /// Adds the values at `t_s`; NaN: unknown. Replaces the last sample if that has the same time.
  void add_sample(double t_s, std::vector<double> values);
  /// Adds an action, such as {"t_s": 0.1, "order": {"min_cell": 2}}.
  void add_action(nlohmann::ordered_json action);
  /// Removes all samples. Later samples continue the numbering.
  void clear_samples();

  /// Returns what follows `place`, and advances `place` to the end: {"stride": 1, "samples":
  /// [[number, t_s, value ...], ...], "actions": [...]}; null if there is nothing new.
  nlohmann::ordered_json take_after(Place& place) const;

 private:
  struct Sample {
    std::uint64_t number;
    double t_s;
    std::vector<double> values;
  };
  bool is_kept(std::uint64_t number) const { return number % stride_ == 0; }

  mutable std::mutex mutex_;
  std::uint64_t stride_ = 1;
  std::vector<Sample> samples_;
  std::deque<nlohmann::ordered_json> actions_;
  Place end_;
};

}  // namespace laboratory
