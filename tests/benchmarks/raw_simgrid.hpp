#pragma once
// The benchmarks of simulated machines, written directly with SimGrid's actors, mailboxes and
// executions. They show the speed that is possible without tlab's machine layer. Messages cost no
// processor time; the only property of a transputer is the rate of its links.
#include "simulator/machine/model.hpp"
#include "tests/benchmarks/measure.hpp"
#include "tests/benchmarks/traffic.hpp"

namespace benchmarks {

Sample raw_line(const machine::Model& model);
Sample raw_mesh(const machine::Model& model, const Traffic& traffic);
// Two actors on one host meet at semaphores. Each then sleeps for the time that copying a message
// takes.
Sample raw_rendezvous(const machine::Model& model, int messages);
// Suspends a long execution for a short one, once in each `period_s`.
Sample raw_preemptions(const machine::Model& model, int times, double period_s, double cycles);

// One activity of a processor: computation, or a message to another processor.
struct Activity {
  int processor, to;  // `to`: the receiver of a message, or the processor itself for a computation
  double work_s;
  std::uint64_t bytes;
};

// Every processor performs its activities in order. One actor sleeps for the computations and sends
// the messages; other actors receive them.
Sample raw_activities(const machine::Model& model, const std::vector<Activity>& activities);

}  // namespace benchmarks
