// A program with a fixed serial fraction. The first processor executes the serial part, then all
// processors share the rest (Amdahl's and Gustafson's laws; thesis, Eq 2.2, 2.3 and 4.29).
#include "simulator/network/store_and_forward.hpp"
#include "simulator/programs/declare/support.hpp"

namespace programs {

namespace law {

constexpr std::uint64_t ORDER_BYTES = 16;  // length of a message with a share or its result

// Process of the first processor: sends every other processor its share of the work, computes a
// share itself, and waits for the results.
void master(network::StoreAndForward& network, int processors, Cycles serial, Cycles share) {
  compute(serial);
  for (int id = 1; id < processors; ++id)
    out(network.into(0), network::Pointer{{0, id, ORDER_BYTES}});
  compute(share);
  for (int id = 1; id < processors; ++id) network.delivered(0).in();
}

void worker(network::StoreAndForward& network, int id, Cycles share) {
  network.delivered(id).in();
  compute(share);
  out(network.into(id), network::Pointer{{id, 0, ORDER_BYTES}});
}

struct Params {
  double serial_fraction = 0.05, work_cycles = 1e8;
  bool scaled = false;
};

struct Measured {
  Seconds time;
  double speedup = 0, efficiency = 0, serial_measured = 0;
};

Outcome<Measured> run(const Setup& setup, const Params& params) {
  const int n = setup.topology.processors;
  const double s = params.serial_fraction, work = params.work_cycles;
  // Cycles of parallel work on each processor.
  const double share = (1 - s) * work / (params.scaled ? 1 : n);
  const double total = s * work + n * share;  // cycles of the whole program
  const auto cycles = [](double c) { return Cycles{std::llround(c)}; };
  Machine machine(setup, n);
  network::StoreAndForward network(machine, setup.topology);
  machine[0].start("master", Priority::low,
                   [&] { master(network, n, cycles(s * work), cycles(share)); });
  for (int id = 1; id < n; ++id)
    machine[id].start("worker", Priority::low, [&, id] { worker(network, id, cycles(share)); });
  run_machine(setup, machine);
  const double speedup = total / setup.model.cpu.clock.value / machine.now().value;
  return Measured{machine.now(), speedup, speedup / n, n > 1 ? (n - speedup) / (n - 1) : s};
}

}  // namespace law

Program make_law() {
  using namespace law;
  using D = base::Declare<Params>;
  return make_program<Params, Measured>(
      {.name = "law",
       .help = "a program with a serial fraction on a network",
       .uses = {.network = true, .threads = true},
       .fields = {D::number(
                      "serial_fraction", &Params::serial_fraction, 0, 1, "",
                      "serial share of the work; with scaled = true, of one processor's work"),
                  D::number("work_cycles", &Params::work_cycles, 1, 1e11, "cycles",
                            "the work; with scaled = true, that of one processor"),
                  D::flag("scaled", &Params::scaled,
                          "true: the parallel part grows with the machine")},
       .columns = {column("time_s", &Measured::time, "time until all processors have finished"),
                   column("speedup", &Measured::speedup,
                          "time of the same work on one processor, over time_s"),
                   column("efficiency", &Measured::efficiency, "speedup over processors"),
                   column("serial_measured", &Measured::serial_measured,
                          "serial fraction computed from the speedup (thesis, Eq 4.29)")},
       .run = &run});
}

}  // namespace programs
