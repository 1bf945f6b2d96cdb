#pragma once
// The benchmarks of simulated machines written directly on SimGrid's actors, mailboxes and
// executions: what a program without tlab's machine layer would run at. No processor time is
// charged for messages, and no transputer is modelled but the rates of its links.
#include "simulator/machine/model.hpp"
#include "tests/benchmarks/measure.hpp"
#include "tests/benchmarks/traffic.hpp"

namespace benchmarks {

Sample raw_line(const machine::Model& model);
Sample raw_mesh(const machine::Model& model, const Traffic& traffic);
// Two actors of one host meet at semaphores and sleep for the time of the copy.
Sample raw_rendezvous(const machine::Model& model, int messages);
// A long execution is suspended for a short one, every `period_s`.
Sample raw_preemptions(const machine::Model& model, int times, double period_s, double cycles);

// What a processor does: it works, or sends to another.
struct Activity {
  int processor, to;  // to: of a message, else itself
  double work_s;
  std::uint64_t bytes;
};

// Every processor does its activities in their order: an actor sleeps for its work and puts its
// messages, others take them.
Sample raw_activities(const machine::Model& model, const std::vector<Activity>& activities);

}  // namespace benchmarks
