#include "simulator/machine/engine.hpp"

#include "simulator/machine/faults.hpp"

namespace machine {

Engine::Engine(EngineParams params) {
  const bool is_direct = params.links == Links::direct;
  if (is_direct && params.processes == Processes::actors)
    throw base::InvariantBroken(
        "found actors with the direct engine, expected them with SimGrid only");
  can_wait_ = is_direct;
  needs_stacks_ = params.processes == Processes::actors;
  carrier_ = is_direct ? make_direct(events_) : make_simgrid(events_, params.processes);
}

void Engine::set_pace(Pace& pace) {
  if (!can_wait_)
    throw base::InvariantBroken("found a pace for SimGrid, expected the direct engine");
  events_.set_pace(&pace);
}

Engine::End Engine::run(Seconds until) {
  events_.set_until(until.value);
  events_.at(0, [] {});  // also causes pending callbacks of soon() to run
  carrier_->run();
  if (events_.end() == End::no_event_left) rewind();
  return events_.end();
}

}  // namespace machine
