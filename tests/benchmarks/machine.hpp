#pragma once
// Declarations that the benchmarks of simulated machines share. Each function add_...() registers
// benchmarks that run_all() executes.
#include "simulator/machine/machine.hpp"
#include "tests/benchmarks/pairs.hpp"

namespace benchmarks {

inline constexpr std::uint64_t PROCESSOR_MEMORY = 1 << 20;  // memory of a processor, bytes

inline const machine::Model& model() {
  static const machine::Model t805 = machine::load_model("t805-25");
  return t805;
}

inline Sample run(machine::Machine& machine, std::uint64_t count) {
  const double cpu_s = time_of([&] { machine.run(); });
  return {count, cpu_s, machine.now() / machine::Seconds{1}, 0};
}

/// The engines that can simulate a machine, by the names that the benchmarks print.
struct Engine {
  const char* by;
  machine::EngineParams params;
};
inline constexpr Engine ENGINES[] = {
    {"tlab", {}},
    {"tlab direct", {.links = machine::Links::direct}},
    {"tlab actors", {.processes = machine::Processes::actors}},
};

/// Adds the benchmark `what` for each engine.
template <class Run>
void add_on_all(const std::string& what, Run run) {
  for (const Engine& engine : ENGINES)
    add_simulation(what, engine.by, [run, engine] { return run(engine.params); });
}

void add_line();       // messages that are stored and forwarded along a line
void add_mesh();       // routers on a mesh of 8 x 8 processors
void add_farm();       // the farm of chapter 4 of the thesis
void add_scheduler();  // rendezvous and pre-emptions of processes on one processor
// messages between neighbours in a mesh: costs per transputer and per event
void add_neighbours();
void add_threads();       // messages between neighbours, simulated on one and on two host threads
void add_renderers();     // the sequential renderer
void add_noise();         // the sequential renderer, with a lens and an area light
void add_form_factors();  // rays in the calculation of form factors

}  // namespace benchmarks
