#pragma once
// Interface of a carrier, which moves messages over links and drives the simulated clock. One
// implementation uses SimGrid, the other computes the times itself.
//
// A carrier numbers the directions of links. The two directions of a link have consecutive numbers,
// of which the lower one is even.
#include <cstdint>
#include <memory>
#include <string>

#include "simulator/machine/carriers/coroutine.hpp"
#include "simulator/machine/carriers/events.hpp"

namespace machine {

/// How the bodies of processes are executed. Results do not depend on this choice.
enum class Processes : std::uint8_t {
  fibers,  ///< tlab itself switches between stacks (make_fiber); several times faster than actors
  actors,  ///< each process is a SimGrid actor, on the SimGrid host that stands for its processor
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
  /// link's position among all links of the machine.
  virtual std::size_t add_link(int a, int b, LinkRates rates, std::size_t rank) = 0;
  virtual std::unique_ptr<Coroutine> make_coroutine(int processor, const std::string& name,
                                                    Coroutine::Body body) = 0;

  /// Moves `bytes` (> 0) over an idle direction, starting now. Calls `arrived` when they have
  /// arrived.
  virtual void start(std::size_t direction, std::uint64_t bytes, Callback arrived) = 0;
  /// Number of bytes of the present message that will still have to be moved at `date`, if no
  /// message starts or ends on the link before that date; 0 if the direction is idle.
  virtual double left_of(std::size_t direction, double date) const = 0;
  /// Cuts a direction. The message being moved never arrives, and no message may start afterwards.
  virtual void cut(std::size_t direction) = 0;
  /// Handles events and moves messages until nothing is left to do or the events are stopped.
  virtual void run() = 0;

  /// For a machine that is divided into parts (class Parts): next() returns the moment of the next
  /// event, and run_before() handles all events before `bound`. Both throw InvariantBroken if the
  /// carrier does not support parts.
  virtual Moment next() = 0;
  virtual void run_before(const Moment& bound) = 0;
};

/// Makes a carrier that uses SimGrid. Each processor is a SimGrid host, and each message a SimGrid
/// communication. Each link is a SimGrid link, with the one-way rate for a single message and the
/// two-way rate for two messages together. SimGrid's engine is a singleton that lives as long as
/// the host process.
std::unique_ptr<Carrier> make_simgrid(Events& events, Processes processes);

/// Makes a carrier without SimGrid, but with the same link model. It computes the end of a message
/// from the link's two rates, with one event per message. A host process may have any number of
/// these carriers. Their processes run on fibers; throws InvariantBroken for Processes::actors.
std::unique_ptr<Carrier> make_direct(Events& events, Processes processes);

using MakeCarrier = std::unique_ptr<Carrier> (*)(Events& events, Processes processes);

/// Version of the linked SimGrid, such as "3.32".
std::string simgrid_version();

}  // namespace machine
