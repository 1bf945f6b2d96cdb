#include "simulator/machine/engine.hpp"

#include "simulator/machine/faults.hpp"

namespace machine {

Engine::Engine(MakeCarrier make, Processes processes)
    : can_wait_(make == &make_direct),
      needs_stacks_(processes == Processes::actors),
      carrier_(make(events_, processes)) {}

void Engine::set_pace(Pace& pace) {
  if (!can_wait_)
    throw base::InvariantBroken("found a pace for SimGrid, expected the direct engine");
  events_.set_pace(&pace);
}

Engine::End Engine::run(Seconds until) {
  events_.set_until(until.value);
  // Schedules an event at time 0. After it, the callbacks that soon() scheduled before the run are
  // called.
  events_.at(0, [] {});
  carrier_->run();
  if (events_.end() == End::no_event_left) rewind();
  return events_.end();
}

}  // namespace machine
