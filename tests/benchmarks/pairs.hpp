#pragma once
// Benchmarks in pairs: tlab and another program do the same work in the same run.
#include <benchmark/benchmark.h>

#include <functional>
#include <string>

#include "tests/benchmarks/measure.hpp"

namespace benchmarks {

// Adds a benchmark "what/who", which calls `run` in this process. The benchmark reports the CPU
// time of its samples, and items per second.
benchmark::internal::Benchmark* add(const std::string& what, const std::string& who,
                                    std::function<Sample(benchmark::State&)> run);

// Adds a benchmark of a simulation, which runs in its own process.
benchmark::internal::Benchmark* add_simulation(const std::string& what, const std::string& who,
                                               std::function<Sample()> run);

// Runs all benchmarks, repeated and interleaved. Then prints a table: for each "what", the medians
// of "what/tlab" and of every other "what/who", and their ratio.
int run_all(int argc, char** argv);

}  // namespace benchmarks
