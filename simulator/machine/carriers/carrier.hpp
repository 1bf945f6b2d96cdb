#pragma once
// Carriers move the messages over the links and so drive the clock: SimGrid, or our own rules.
//
// A carrier numbers the directions of links; a link has two consecutive numbers, the first even.
#include <cstdint>
#include <memory>
#include <string>

#include "simulator/machine/carriers/coroutine.hpp"
#include "simulator/machine/carriers/events.hpp"

namespace machine {

/// Implementation of process bodies. Results are the same, byte by byte.
enum class Processes : std::uint8_t {
  fibers,  ///< our own stacks, see make_fiber; several times faster
  actors,  ///< SimGrid actors, each on the SimGrid host of its processor
};

struct LinkRates {
  double one_way;    ///< bytes/s of a direction alone
  double both_ways;  ///< bytes/s of both directions together
};

class Carrier {
 public:
  virtual ~Carrier() = default;

  /// Builds the network; only before run(). Processors are numbered from 0 in order of creation.
  virtual void add_processor(const std::string& name) = 0;
  /// Returns the number of the direction from a to b. `rank`: rank of the link in the machine.
  virtual std::size_t add_link(int a, int b, LinkRates rates, std::size_t rank) = 0;
  virtual std::unique_ptr<Coroutine> make_coroutine(int processor, const std::string& name,
                                                    Coroutine::Body body) = 0;

  /// Moves `bytes` (> 0) over an idle direction, from now on, then handles `arrived`.
  virtual void start(std::size_t direction, std::uint64_t bytes, Callback arrived) = 0;
  /// Bytes still to move at `date`, if no message starts or ends on the link before; 0 without a
  /// message.
  virtual double left_of(std::size_t direction, double date) const = 0;
  /// Cuts a direction. The message under way never arrives, and no new one may start.
  virtual void cut(std::size_t direction) = 0;
  /// Handles events and moves messages until neither is left, or the events are stopped.
  virtual void run() = 0;

  /// For the engines of a machine's parts, see Parts: next() returns the moment of the next event,
  /// run_before() handles all events before `bound`. Throw InvariantBroken if the carrier cannot.
  virtual Moment next() = 0;
  virtual void run_before(const Moment& bound) = 0;
};

/// SimGrid: a processor is a SimGrid host, a message a communication. A link is a SimGrid link with
/// the unidirectional rate for one message and the bidirectional rate shared by two. Its engine is
/// a singleton: one in the life of a host process.
std::unique_ptr<Carrier> make_simgrid(Events& events, Processes processes);

/// The same links without SimGrid: the end of a message follows from the two rates. One event per
/// message, any number of carriers in a host process; processes run on fibers.
std::unique_ptr<Carrier> make_direct(Events& events);

/// Version of the linked SimGrid: "3.32".
std::string simgrid_version();

}  // namespace machine
