#pragma once
// Declarations shared by the benchmarks of simulated machines. Each function adds its cases for
// run_all().
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

/// The engines of the machine, by the names used in the benchmarks.
struct Engine {
  const char* by;
  machine::EngineParams params;
};
inline constexpr Engine ENGINES[] = {
    {"tlab", {}},
    {"tlab direct", {.links = machine::Links::direct}},
    {"tlab actors", {.processes = machine::Processes::actors}},
};

/// Adds `run` as a case for each engine.
template <class Run>
void add_on_all(const std::string& what, Run run) {
  for (const Engine& engine : ENGINES)
    add_simulation(what, engine.by, [run, engine] { return run(engine.params); });
}

void add_line();       // a line of store-and-forward hops
void add_mesh();       // routers on an 8 x 8 mesh
void add_farm();       // the farm of chapter 4
void add_scheduler();  // rendezvous and pre-emptions on one processor
// message exchange between neighbours of a mesh: costs per transputer and per event
void add_neighbours();
void add_threads();       // message exchange with one thread of the host and with two
void add_renderers();     // the sequential renderer
void add_noise();         // the sequential renderer with a lens and an area light
void add_form_factors();  // rays of form factors

}  // namespace benchmarks
