#pragma once
// Bounds of the dates when messages on links end, by the fluid model of each link by itself.
// SimGrid, which moves the messages, decides; the forecast saves asking it too early.
#include <array>
#include <cstdint>
#include <vector>

namespace machine {

class Forecast {
 public:
  /// Rates in bytes/s: of one direction while the other is idle, and of both together. Returns the
  /// number of the link's direction there; that of its direction back is one higher.
  std::size_t add_link(double one_way, double both_ways);

  /// Bounds of the end of a message. They hold until the next start on its link, which can only
  /// make them later.
  struct Bounds {
    double earliest, latest;
    bool contain(double date) const { return earliest <= date && date <= latest; }
  };
  /// A message of `bytes` starts on an idle direction; it ends there, or is lost, and its bounds
  /// are returned. Dates are seconds, ascending.
  void start(std::size_t direction, double bytes, double date);
  Bounds end(std::size_t direction, double date);
  /// The lowest bounds of all; infinity if no message is under way.
  Bounds next();

 private:
  struct Way {
    double left = 0;          // bytes, at the link's `since`
    std::uint64_t valid = 0;  // the number of its bounds; 0 while it is idle
    Bounds bounds{};
  };
  struct Link {
    double alone, shared;  // bytes/s of a direction
    double since = 0;
    std::array<Way, 2> ways{};
  };
  // Entries whose number is not valid any more are dropped when they come to the top.
  struct Entry {
    double earliest;
    std::size_t direction;
    std::uint64_t number;
    bool operator<(const Entry& o) const { return earliest > o.earliest; }
  };
  static void advance(Link& link, double date);
  Way& way(std::size_t direction) { return links_[direction / 2].ways[direction % 2]; }
  void predict(std::size_t direction);

  std::vector<Link> links_;
  std::vector<Entry> heap_;
  std::uint64_t numbers_ = 0;
};

}  // namespace machine
