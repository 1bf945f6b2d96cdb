#pragma once
// Interface of the carriers, which move messages over links and drive the clock. One implementation
// uses SimGrid, another its own rules.
//
// A carrier numbers the directions of links. The two directions of a link have consecutive numbers,
// the first of them even.
#include <cstdint>
#include <memory>
#include <string>

#include "simulator/machine/carriers/coroutine.hpp"
#include "simulator/machine/carriers/events.hpp"

namespace machine {

/// Implementation of process bodies. The results do not depend on it.
enum class Processes : std::uint8_t {
  fibers,  ///< stacks switched by tlab, see make_fiber; several times faster
  actors,  ///< SimGrid actors on the SimGrid host of their processor
};

struct LinkRates {
  double one_way;    ///< bytes/s of one direction while the opposite one is idle
  double both_ways;  ///< bytes/s of both directions together while both are busy
};

class Carrier {
 public:
  virtual ~Carrier() = default;

  /// Adds a processor before run(). Processors are numbered from 0 in the order of these calls.
  virtual void add_processor(const std::string& name) = 0;
  /// Adds a link before run() and returns the number of its direction from a to b. `rank` is the
  /// link's position in the machine's order of links.
  virtual std::size_t add_link(int a, int b, LinkRates rates, std::size_t rank) = 0;
  virtual std::unique_ptr<Coroutine> make_coroutine(int processor, const std::string& name,
                                                    Coroutine::Body body) = 0;

  /// Moves `bytes` (> 0) over an idle direction, starting now, then calls `arrived`.
  virtual void start(std::size_t direction, std::uint64_t bytes, Callback arrived) = 0;
  /// Number of bytes of the current message that are still to be moved at `date`, provided that no
  /// message starts or ends on the link before; 0 if the direction is idle.
  virtual double left_of(std::size_t direction, double date) const = 0;
  /// Cuts a direction. The current message never arrives, and no message may start afterwards.
  virtual void cut(std::size_t direction) = 0;
  /// Handles events and moves messages until none are left or the events are stopped.
  virtual void run() = 0;

  /// For a machine in several parts, see Parts. next() returns the moment of the next event, and
  /// run_before() handles all events before `bound`. Both throw InvariantBroken if the carrier does
  /// not support parts.
  virtual Moment next() = 0;
  virtual void run_before(const Moment& bound) = 0;
};

/// Makes a carrier on SimGrid. Each processor is a SimGrid host and each message a communication.
/// Each link is a SimGrid link with the one-way rate for one message and the two-way rate shared by
/// two. SimGrid's engine is a singleton that lives as long as the host process.
std::unique_ptr<Carrier> make_simgrid(Events& events, Processes processes);

/// Makes a carrier without SimGrid, with the link model of make_simgrid(). It computes the end of a
/// message from the two rates, with one event per message. A host process may have any number of
/// these carriers; simulated processes run on fibers. Throws InvariantBroken for actors.
std::unique_ptr<Carrier> make_direct(Events& events, Processes processes);

using MakeCarrier = std::unique_ptr<Carrier> (*)(Events& events, Processes processes);

/// Version of the linked SimGrid, such as "3.32".
std::string simgrid_version();

}  // namespace machine
