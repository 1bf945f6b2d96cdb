#pragma once
// Predicts when messages arrive. On each link, bytes flow continuously at a constant rate, which
// depends on whether the opposite direction is busy (a fluid model).
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "simulator/machine/carriers/events.hpp"

namespace machine {

class Forecast {
 public:
  /// Adds a link and returns the number of its forward direction; the backward direction has the
  /// next number. `one_way` is the rate in bytes/s of one direction while the other is idle.
  /// `both_ways` is the sum of both rates while both are busy. `rank` must increase from link to
  /// link.
  std::size_t add_link(double one_way, double both_ways, std::size_t rank = 0);

  /// start() begins a message of `bytes` on an idle direction. end() ends the message, because it
  /// has arrived or is lost. Dates are in seconds and must not decrease.
  void start(std::size_t direction, double bytes, double date);
  void end(std::size_t direction, double date);
  /// Updates the predictions for links where messages have started or ended since the last call.
  void settle() {
    if (!changed_.empty()) foresee_changed();
  }

  /// Number of bytes of a message left at `date`, if no message starts or ends on its link before
  /// that date; 0 if the direction is idle.
  double left(std::size_t direction, double date) const;

  /// Predicted end of a message. Messages that start later on the same link can only delay it.
  struct End {
    double date = std::numeric_limits<double>::infinity();  ///< infinite if the direction is idle
    double hair = 0;  ///< tolerance for rounding errors of SimGrid, in seconds
    std::size_t direction = 0;
    double earliest() const { return date - hair; }
    double latest() const { return date + hair; }
    bool contains(double other) const { return earliest() <= other && other <= latest(); }
  };
  /// Returns the earliest predicted end of all messages. Among equal dates, the earlier prediction
  /// comes first, then the lower rank of the link. On one link, the message that started last comes
  /// first, as in SimGrid.
  const End& next() {
    static constexpr End NONE = {};
    return next_date() < NONE.date ? end_of(heap_.front().direction) : NONE;
  }
  double next_date() {
    while (!heap_.empty() && way(heap_.front().direction).valid != heap_.front().number) drop_top();
    return heap_.empty() ? std::numeric_limits<double>::infinity() : heap_.front().date;
  }
  Moment next_moment();
  const End& end_of(std::size_t direction) const { return way(direction).end; }

 private:
  struct Way {
    double left = 0;  // number of bytes left at the date `since` of the link
    bool busy = false;
    std::uint64_t valid = 0;  // number of this direction's only valid entry in the heap
    End end = {};
  };
  struct Link {
    // Rates of a direction in bytes/s: `alone` while the opposite direction is idle, `shared` while
    // both are busy.
    double alone, shared;
    std::size_t rank;
    double since = 0;
    std::array<Way, 2> ways = {};
    std::size_t newest = 0;  // direction of the message that started last
    bool changed = false;
  };
  // An entry of the heap. It is outdated if its number differs from Way::valid; it is removed when
  // it reaches the top.
  struct Entry {
    double date, since;
    std::uint64_t number;
    std::size_t direction;
    bool is_newest;
    bool operator<(const Entry& o) const {  // reversed, so that the next end is on top of the heap
      if (date != o.date) return date > o.date;
      if (since != o.since) return since > o.since;
      return direction / 2 != o.direction / 2 ? direction > o.direction : o.is_newest;
    }
  };
  const Way& way(std::size_t direction) const { return links_[direction / 2].ways[direction % 2]; }
  void foresee_changed();
  void drop_top();
  static double left(const Link& link, std::size_t way, double date);
  Link& change(std::size_t direction, double date);
  void foresee(Link& link, std::size_t direction);

  std::vector<Link> links_;
  std::vector<std::size_t> changed_;  // indices of links whose predictions are outdated
  std::vector<Entry> heap_;
  std::uint64_t numbers_ = 0;
};

}  // namespace machine
