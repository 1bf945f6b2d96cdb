// A program with a set serial fraction: the first processor does the serial part, then all share
// the rest. Amdahl's and Gustafson's laws, thesis Eq 2.2, 2.3 and 4.29.
#include "simulator/declare/support.hpp"
#include "simulator/network/store_and_forward.hpp"

namespace programs {

namespace {

constexpr std::uint64_t ORDER_BYTES = 16;  // what a share or its result takes on a link

// Sends every other processor its share, does its own, and waits for theirs.
void master(network::StoreAndForward& network, int processors, Cycles serial, Cycles share) {
  compute(serial);
  network::Pointer order;
  for (int id = 1; id < processors; ++id) {
    order.to = {0, id, ORDER_BYTES, 0, {}};
    out(network.into(0), order);
  }
  compute(share);
  for (int id = 1; id < processors; ++id) network.delivered(0).in();
}

void worker(network::StoreAndForward& network, int id, Cycles share) {
  network.delivered(id).in();
  compute(share);
  network::Pointer result;
  result.to = {id, 0, ORDER_BYTES, 0, {}};
  out(network.into(id), result);
}

Row run(const Setup& setup) {
  const int n = setup.topology.processors;
  const double s = setup["serial_fraction"], work = setup["work_cycles"];
  const bool scaled = setup["scaled"] != 0;
  const double share = (1 - s) * work / (scaled ? 1 : n);  // of a processor, of the parallel part
  const double total = s * work + n * share;               // of one processor alone
  const auto cycles = [](double c) { return Cycles{std::llround(c)}; };
  machine::Machine machine(setup.model);
  add_processors(machine, n);
  network::StoreAndForward network(machine, setup.topology);
  machine.processors()[0]->start("master", Priority::low,
                                 [&] { master(network, n, cycles(s * work), cycles(share)); });
  for (int id = 1; id < n; ++id)
    machine.processors()[id]->start("worker", Priority::low,
                                    [&, id] { worker(network, id, cycles(share)); });
  run_machine(setup, machine);
  const double time_s = machine.now().value;
  const double speedup = total / setup.model.cpu.clock.value / time_s;
  return {{"time_s", time_s},
          {"speedup", speedup},
          {"efficiency", speedup / n},
          {"serial_measured", n > 1 ? (n - speedup) / (n - 1) : s}};
}

}  // namespace

Pattern make_law() {
  return {"law",
          "a program with a serial fraction on a network: speedup over one processor; "
          "serial_measured, the thesis's Eq 4.29",
          true,
          {{"serial_fraction", 0.05, 0, 1, false, "of the work (where scaled: of one processor's)"},
           {"work_cycles", 1e8, 1, 1e11, true, "the work; where scaled, of one processor"},
           {"scaled", 0, 0, 1, true, "the parallel part grows with the machine, 1, or not, 0"}},
          &run};
}

}  // namespace programs
