#pragma once
// The dates when messages on links end, by the fluid model of each link by itself.
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "simulator/machine/carriers/events.hpp"

namespace machine {

class Forecast {
 public:
  /// Rates in bytes/s: of one direction while the other is idle, and of both together. `rank` grows
  /// from link to link. Returns the number of the link's direction there; that of its direction
  /// back is one higher.
  std::size_t add_link(double one_way, double both_ways, std::size_t rank = 0);

  /// A message of `bytes` starts on an idle direction; it ends there, or is lost. Dates are
  /// seconds, ascending.
  void start(std::size_t direction, double bytes, double date);
  void end(std::size_t direction, double date);
  /// Foresees the ends on the links where messages have started or ended.
  void settle() {
    if (!changed_.empty()) foresee_changed();
  }

  /// The bytes of a message that are left at `date`, if none starts or ends on its link before; 0
  /// without one.
  double left(std::size_t direction, double date) const;

  /// When a message ends, if no other starts on its link before, which can only make it later.
  struct End {
    double date = std::numeric_limits<double>::infinity();  ///< infinite without a message
    double hair = 0;  ///< seconds that SimGrid, which rounds, may be early or late
    std::size_t direction = 0;
    double earliest() const { return date - hair; }
    double latest() const { return date + hair; }
    bool contains(double other) const { return earliest() <= other && other <= latest(); }
  };
  /// The first end of all that were foreseen, and the end of one message under way. Of those that
  /// end together, the one that was foreseen first comes first. If they were foreseen together, it
  /// is that of the link of lower rank; on one link that of the newer message, as on SimGrid.
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
    std::uint64_t valid = 0;  // the number of its end in the heap
    End end = {};
  };
  struct Link {
    double alone, shared;  // bytes/s of a direction
    std::size_t rank;
    double since = 0;
    std::array<Way, 2> ways = {};
    std::size_t newest = 0;  // the way whose message has started last
    bool changed = false;
  };
  // Entries whose number is not valid any more are dropped when they come to the top.
  struct Entry {
    double date, since;
    std::uint64_t number;
    std::size_t direction;
    bool is_newest;
    bool operator<(const Entry& o) const {  // for a heap whose top is the next end
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
  std::vector<std::size_t> changed_;  // links
  std::vector<Entry> heap_;
  std::uint64_t numbers_ = 0;
};

}  // namespace machine
