#pragma once
// Benchmarks in pairs: tlab and another program do the same work, one after the other.
#include <benchmark/benchmark.h>

#include <functional>
#include <string>

#include "tests/benchmarks/measure.hpp"

namespace benchmarks {

// Adds the benchmark "what/who", which calls `run` in this process. The benchmark reports the CPU
// time of the returned samples, and the amount of work per second.
benchmark::internal::Benchmark* add(const std::string& what, const std::string& who,
                                    std::function<Sample(benchmark::State&)> run);

// Adds a benchmark of a simulation. The simulation runs in a process of its own.
benchmark::internal::Benchmark* add_simulation(const std::string& what, const std::string& who,
                                               std::function<Sample()> run);

// Executes all benchmarks several times, in random order. Then prints a table with a row for each
// "what": the medians of "what/tlab" and of every other "what/who", and their ratio.
int run_all(int argc, char** argv);

}  // namespace benchmarks
