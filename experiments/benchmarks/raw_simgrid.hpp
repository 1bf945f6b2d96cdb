#pragma once
// The cases of the machine benchmark written directly on SimGrid's actors, mailboxes and
// executions: what a program without tlab's machine layer would run at. No processor time is
// charged for messages, and no transputer is modelled but the rates of its links.
#include "experiments/benchmarks/measure.hpp"
#include "experiments/benchmarks/traffic.hpp"
#include "simulator/machine/model.hpp"

namespace benchmarks {

Sample raw_line(const machine::Model& model);
Sample raw_mesh(const machine::Model& model, const Traffic& traffic);
// Two actors of one host meet at semaphores and sleep for the time of the copy.
Sample raw_rendezvous(const machine::Model& model, int messages);
// A long execution is suspended for a short one, every `period_s`.
Sample raw_preemptions(const machine::Model& model, int times, double period_s, double cycles);

}  // namespace benchmarks
