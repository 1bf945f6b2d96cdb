#include "simulator/machine/forecast.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <utility>

namespace machine {

std::size_t Forecast::add_link(double one_way, double both_ways) {
  links_.push_back({std::min(one_way, both_ways), std::min(one_way, both_ways / 2)});
  return 2 * (links_.size() - 1);
}

void Forecast::advance(Link& link, double date) {
  const bool both = link.ways[0].valid && link.ways[1].valid;
  for (Way& way : link.ways)
    way.left = std::max(0.0, way.left - (both ? link.shared : link.alone) * (date - link.since));
  link.since = date;
}

void Forecast::start(std::size_t direction, double bytes, double date) {
  Link& link = links_[direction / 2];
  advance(link, date);
  link.ways[direction % 2].left = bytes;
  predict(direction);
  if (link.ways[1 - direction % 2].valid) predict(direction ^ 1);
}

Forecast::Bounds Forecast::end(std::size_t direction, double date) {
  advance(links_[direction / 2], date);
  return std::exchange(way(direction), {}).bounds;
}

// Both share the link until the shorter ends. SimGrid rounds dates, the later the more: a hair
// early, and late.
void Forecast::predict(std::size_t direction) {
  Link& link = links_[direction / 2];
  Way& own = link.ways[direction % 2];
  const Way& other = link.ways[1 - direction % 2];
  const double together = other.valid ? std::min(own.left, other.left) : 0;
  const double duration = together / link.shared + (own.left - together) / link.alone;
  const double date = link.since + duration, hair = 1e-9 * duration + 1e-11 + 1e-14 * date;
  own.valid = ++numbers_;
  own.bounds = {date - hair, date + hair};
  heap_.push_back({own.bounds.earliest, direction, own.valid});
  std::ranges::push_heap(heap_, std::less<>());
}

Forecast::Bounds Forecast::next() {
  const auto is_old = [&](const Entry& e) { return way(e.direction).valid != e.number; };
  while (!heap_.empty() && is_old(heap_.front())) {
    std::ranges::pop_heap(heap_, std::less<>());
    heap_.pop_back();
  }
  constexpr double NEVER = std::numeric_limits<double>::infinity();
  return heap_.empty() ? Bounds{NEVER, NEVER} : way(heap_.front().direction).bounds;
}

}  // namespace machine
