#include "simulator/snapshots/recorder.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "simulator/machine/process.hpp"

namespace snapshots {

namespace {
constexpr std::int64_t MOST_MULTIPLES = 1000;
}

Recorder::Recorder(Schedule snapshot_times, const observe::RunMonitor* monitor)
    : schedule_(std::move(snapshot_times)), monitor_(monitor) {}

double Recorder::next_picture_s() const {
  double next_s = std::numeric_limits<double>::infinity();
  if (next_at_ < schedule_.at_s.size()) next_s = schedule_.at_s[next_at_];
  if (schedule_.every_s > 0 && next_multiple_ <= MOST_MULTIPLES)
    next_s = std::min(next_s, static_cast<double>(next_multiple_) * schedule_.every_s);
  return next_s;
}

void Recorder::note(double now_s, const std::function<Snapshot()>& look) {
  if (monitor_) observe::notify_change(monitor_, machine::this_process().now());
  take(now_s, look);
}

void Recorder::take(double now_s, const std::function<Snapshot()>& look) {
  for (double at_s = next_picture_s(); at_s <= now_s; at_s = next_picture_s()) {
    pictures_.push_back(look());
    pictures_.back().at_s = at_s;
    while (next_at_ < schedule_.at_s.size() && schedule_.at_s[next_at_] <= at_s) ++next_at_;
    if (static_cast<double>(next_multiple_) * schedule_.every_s <= at_s) ++next_multiple_;
  }
  if (schedule_.growth == 0) return;
  while (static_cast<double>(next_growth_) * growth_interval_s_ <= now_s) {
    growth_.push_back(look());
    growth_.back().at_s = static_cast<double>(next_growth_++) * growth_interval_s_;
    if (growth_.size() < 2 * static_cast<std::size_t>(schedule_.growth)) continue;
    // Keeps every second picture and doubles the interval between pictures.
    for (std::size_t i = 0; 2 * i < growth_.size(); ++i) std::swap(growth_[i], growth_[2 * i]);
    growth_.resize((growth_.size() + 1) / 2);
    growth_interval_s_ *= 2;
    next_growth_ = (next_growth_ + 1) / 2;
  }
}

void Recorder::end(double now_s, const std::function<Snapshot()>& look) {
  take(now_s, look);
  if (schedule_.growth == 0 || (!growth_.empty() && growth_.back().at_s >= now_s)) return;
  growth_.push_back(look());
  growth_.back().at_s = now_s;
}

}  // namespace snapshots
