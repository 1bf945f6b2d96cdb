#include "experiments/laboratory/live/history.hpp"

#include <algorithm>

namespace laboratory {

using nlohmann::ordered_json;

void History::add_sample(double t_s, std::vector<double> values) {
  const std::lock_guard lock(mutex_);
  const bool is_again = !samples_.empty() && samples_.back().t_s == t_s;
  if (is_again || (samples_.size() > 1 && !is_kept(samples_.back().number))) samples_.pop_back();
  samples_.push_back({++end_.samples, t_s, std::move(values)});
  if (samples_.size() <= MOST_SAMPLES) return;
  stride_ *= 2;
  const auto first = samples_.front().number, last = samples_.back().number;
  std::erase_if(samples_, [&](const Sample& sample) {
    return !is_kept(sample.number) && sample.number != first && sample.number != last;
  });
}

void History::add_action(ordered_json action) {
  const std::lock_guard lock(mutex_);
  actions_.push_back(std::move(action));
  ++end_.actions;
  if (actions_.size() > MOST_ACTIONS) actions_.pop_front();
}

void History::clear_samples() {
  const std::lock_guard lock(mutex_);
  samples_.clear();
  stride_ = 1;
}

ordered_json History::take_after(Place& place) const {
  const std::lock_guard lock(mutex_);
  if (place.samples == end_.samples && place.actions == end_.actions) return {};
  auto samples = ordered_json::array(), actions = samples;
  const auto first = std::ranges::upper_bound(samples_, place.samples, {}, &Sample::number);
  for (auto sample = first; sample != samples_.end(); ++sample) {
    samples.push_back({sample->number, sample->t_s});
    for (const double value : sample->values) samples.back().push_back(value);  // NaN becomes null
  }
  const auto count = std::min(end_.actions - place.actions, std::uint64_t{actions_.size()});
  for (auto i = actions_.size() - count; i < actions_.size(); ++i) actions.push_back(actions_[i]);
  place = end_;
  return {{"stride", stride_}, {"samples", samples}, {"actions", actions}};
}

}  // namespace laboratory
