#pragma once
// Predicted end dates of messages, from a fluid model of each link by itself.
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "simulator/machine/carriers/events.hpp"

namespace machine {

class Forecast {
 public:
  /// Rates in bytes/s: of one direction while the other is idle, and of both together. `rank` grows
  /// from link to link. Returns the number of the forward direction; the direction back has the
  /// next number.
  std::size_t add_link(double one_way, double both_ways, std::size_t rank = 0);

  /// start(): a message of `bytes` begins on an idle direction. end(): it has arrived or is lost.
  /// Dates are in seconds, ascending.
  void start(std::size_t direction, double bytes, double date);
  void end(std::size_t direction, double date);
  /// Updates the predictions of links after starts and ends of messages.
  void settle() {
    if (!changed_.empty()) foresee_changed();
  }

  /// Bytes of a message left at `date`, if none starts or ends on its link before; 0 without one.
  double left(std::size_t direction, double date) const;

  /// Predicted end of a message. Another message that starts on its link can only delay it.
  struct End {
    double date = std::numeric_limits<double>::infinity();  ///< infinite without a message
    double hair = 0;  ///< tolerance in seconds, for SimGrid's rounding
    std::size_t direction = 0;
    double earliest() const { return date - hair; }
    double latest() const { return date + hair; }
    bool contains(double other) const { return earliest() <= other && other <= latest(); }
  };
  /// The earliest predicted end, and the end of one message under way. Ties: the earlier prediction
  /// comes first, then the link of lower rank. On one link the newer message comes first, as on
  /// SimGrid.
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
    double left = 0;  // bytes, at the link's `since`
    bool busy = false;
    std::uint64_t valid = 0;  // number of its end in the heap
    End end = {};
  };
  struct Link {
    double alone, shared;  // bytes/s of a direction: other one idle, both busy
    std::size_t rank;
    double since = 0;
    std::array<Way, 2> ways = {};
    std::size_t newest = 0;  // way with the message started last
    bool changed = false;
  };
  // Entries with an outdated number are dropped when they reach the top.
  struct Entry {
    double date, since;
    std::uint64_t number;
    std::size_t direction;
    bool is_newest;
    bool operator<(const Entry& o) const {  // the next end is the top of the heap
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
  std::vector<std::size_t> changed_;  // link numbers
  std::vector<Entry> heap_;
  std::uint64_t numbers_ = 0;
};

}  // namespace machine
