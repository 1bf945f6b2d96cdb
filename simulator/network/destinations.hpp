#pragma once
// Destinations of random messages: the traffic patterns with which networks are compared (W. Dally
// and B. Towles, Principles and Practices of Interconnection Networks, 2004, section 3.2).
#include <optional>
#include <string>
#include <vector>

#include "base/fields.hpp"
#include "base/random.hpp"
#include "topologies/route/routes.hpp"

namespace network {

enum class Pattern {
  uniform,         ///< any other processor, all with equal probability
  transpose,       ///< row r, column c of a square matrix sends to row c, column r
  bit_complement,  ///< the number with all bits inverted
  bit_reversal,    ///< the number with its bits in reverse order
  shuffle,         ///< the number rotated left by one bit
  hot_spot,        ///< a given processor with a given probability, otherwise as with `uniform`
  neighbour,       ///< any processor at the other end of a link, with equal probability
  file             ///< probabilities from a file
};

struct PatternParams {
  Pattern pattern = Pattern::uniform;
  int hot_spot = 0;        ///< number of the processor that receives more than the others
  double hot_share = 0.1;  ///< probability that a message goes to the hot spot
  base::Source file = {};  ///< CSV with the columns from, to and weight, for Pattern::file
};

/// Parameters of a program that sends random messages.
base::Fields<PatternParams> pattern_fields();

/// Returns the parameter whose value makes the parameter `key` irrelevant, or "" if there is none.
std::string find_void(const PatternParams& params, const std::string& key);

/// The probability that a message from one processor goes to another.
class Destinations {
 public:
  /// Throws BadInput that names the parameter if the pattern does not suit the number of
  /// processors, if there is only one processor, or if the file is invalid. The permutations of
  /// bits need a power of two, and transpose needs a square number.
  Destinations(const PatternParams& params, const topologies::Topology& topology);

  /// Draws the destination of the next message. Returns nothing if `from` sends no messages, as on
  /// the diagonal of transpose, where sender and destination are the same processor.
  std::optional<int> draw(int from, base::Random& random) const;

  /// Number of messages on the busiest direction of a link if every sender sends one message on
  /// `routes`. Takes time proportional to the square of the number of processors if the pattern is
  /// uniform or hot_spot.
  double eval_busiest_link(const topologies::Topology& topology,
                           const topologies::RoutingTable& routes) const;
  /// The largest load that a network can accept on given routes, as a fraction of the capacity of a
  /// link direction: at this load the busiest link direction is always busy, if routers take no
  /// time. No value for more than 4096 processors, where it would take too long.
  std::optional<double> eval_saturation_load(const topologies::Topology& topology,
                                             const topologies::RoutingTable& routes) const;
  /// Mean number of links on the routes of messages. Every sender has the same weight.
  double eval_mean_distance(const topologies::RoutingTable& routes) const;

 private:
  struct Share {
    int to;
    double until;  // sum of the probabilities up to and including this destination
  };
  void add_permutation(Pattern pattern);
  void add_neighbours(const topologies::Topology& topology);
  void add_hot_spot(const PatternParams& params);
  void read_file(const base::Source& file);

  int processors_;
  double uniform_ = 0;  // probability of a destination drawn from all other processors
  // By sender: shares of the other destinations; empty if there are none.
  std::vector<std::vector<Share>> shares_;
};

/// The column "saturation_load" with the result of Destinations::eval_saturation_load.
template <class R>
base::Column<R> saturation_load_column(std::optional<double> R::*saturation_load) {
  return base::column("saturation_load", saturation_load,
                      "load at which the busiest link would always be busy if routers took no "
                      "time, from pattern and routes; empty for more than 4096 processors");
}

}  // namespace network
