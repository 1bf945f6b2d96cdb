#pragma once
// Benchmarks in pairs: the same work done by tlab and by another program, in the same run.
#include <benchmark/benchmark.h>

#include <functional>
#include <string>

#include "tests/benchmarks/measure.hpp"

namespace benchmarks {

// A benchmark "what/who" whose time is that of the samples, and which reports their items a second.
// `run` is called in this process.
benchmark::internal::Benchmark* add(const std::string& what, const std::string& who,
                                    std::function<Sample(benchmark::State&)> run);

// The same of a simulation, which has a process of its own.
benchmark::internal::Benchmark* add_simulation(const std::string& what, const std::string& who,
                                               std::function<Sample()> run);

// Runs all, repeated and interleaved, and ends with a table: for each "what" the median of
// "what/tlab" beside that of every other "what/who", and their ratio.
int run_all(int argc, char** argv);

}  // namespace benchmarks
