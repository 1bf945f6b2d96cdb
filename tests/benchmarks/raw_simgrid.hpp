#pragma once
// The benchmarks of simulated machines, written directly on SimGrid's actors, mailboxes and
// executions. They show the speed without tlab's machine layer. Messages cost no processor time.
// The only property of a transputer here is the rate of its links.
#include "simulator/machine/model.hpp"
#include "tests/benchmarks/measure.hpp"
#include "tests/benchmarks/traffic.hpp"

namespace benchmarks {

Sample raw_line(const machine::Model& model);
Sample raw_mesh(const machine::Model& model, const Traffic& traffic);
// Two actors of one host meet at semaphores, and sleep as long as the copy of a message takes.
Sample raw_rendezvous(const machine::Model& model, int messages);
// Suspends a long execution for a short one, every `period_s`.
Sample raw_preemptions(const machine::Model& model, int times, double period_s, double cycles);

// One activity of a processor: work, or a message to another processor.
struct Activity {
  int processor, to;  // `to`: receiver of a message; for work, the processor itself
  double work_s;
  std::uint64_t bytes;
};

// Every processor performs its activities in order. An actor sleeps for its work and sends its
// messages, other actors receive them.
Sample raw_activities(const machine::Model& model, const std::vector<Activity>& activities);

}  // namespace benchmarks
