#include "simulator/machine/carriers/forecast.hpp"

#include <algorithm>
#include <functional>
#include <utility>

namespace machine {

std::size_t Forecast::add_link(double one_way, double both_ways, std::size_t rank) {
  links_.push_back({std::min(one_way, both_ways), std::min(one_way, both_ways / 2), rank});
  return 2 * (links_.size() - 1);
}

double Forecast::left(const Link& link, std::size_t way, double date) {
  const bool both = link.ways[0].busy && link.ways[1].busy;
  const double rate = both ? link.shared : link.alone;
  return std::max(0.0, link.ways[way].left - rate * (date - link.since));
}

double Forecast::left(std::size_t direction, double date) const {
  return way(direction).busy ? left(links_[direction / 2], direction % 2, date) : 0;
}

// Computes the bytes left in both directions at `date`, and marks the link's predictions as
// outdated. Must be called before the rates change.
Forecast::Link& Forecast::change(std::size_t direction, double date) {
  Link& link = links_[direction / 2];
  const std::array left_now{left(link, 0, date), left(link, 1, date)};
  for (std::size_t way = 0; way < 2; ++way) link.ways[way].left = left_now[way];
  link.since = date;
  if (!std::exchange(link.changed, true)) changed_.push_back(direction / 2);
  return link;
}

void Forecast::start(std::size_t direction, double bytes, double date) {
  Link& link = change(direction, date);
  link.newest = direction % 2;
  link.ways[link.newest].left = bytes;
  link.ways[link.newest].busy = true;
}

void Forecast::end(std::size_t direction, double date) {
  change(direction, date).ways[direction % 2] = {};
}

void Forecast::foresee_changed() {
  for (const std::size_t number : changed_) {
    Link& link = links_[number];
    link.changed = false;
    foresee(link, 2 * number);
    foresee(link, 2 * number + 1);
  }
  changed_.clear();
}

// Predicts the end of a message. Two messages in opposite directions share the link until the
// shorter one ends. The tolerance grows with the date, as SimGrid's rounding error does.
void Forecast::foresee(Link& link, std::size_t direction) {
  Way& own = link.ways[direction % 2];
  const Way& other = link.ways[1 - direction % 2];
  if (!own.busy) return;
  const double together = other.busy ? std::min(own.left, other.left) : 0;
  const double duration = together / link.shared + (own.left - together) / link.alone;
  const double date = link.since + duration;
  own.valid = ++numbers_;
  own.end = {date, 1e-9 * duration + 1e-11 + 1e-14 * date, direction};
  heap_.push_back({date, link.since, own.valid, direction, direction % 2 == link.newest});
  std::ranges::push_heap(heap_, std::less<>());
}

Moment Forecast::next_moment() {
  if (next_date() == Events::NEVER) return {};
  const Entry& first = heap_.front();
  return {first.date, Events::ENDS, first.since,
          2 * links_[first.direction / 2].rank + (first.is_newest ? 0 : 1)};
}

void Forecast::drop_top() {
  std::ranges::pop_heap(heap_, std::less<>());
  heap_.pop_back();
}

}  // namespace machine
