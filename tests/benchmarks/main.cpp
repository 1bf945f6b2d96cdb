// Speed of tlab's simulator and renderer, compared with other programs that do the same work.
//
//   benchmarks [--benchmark_filter=REGEX] [--benchmark_repetitions=N] ...     as Google Benchmark
#include "tests/benchmarks/machine.hpp"

int main(int argc, char** argv) try {
  using namespace benchmarks;
  add_line();
  add_mesh();
  add_farm();
  add_scheduler();
  add_neighbours();
  add_threads();
  add_renderers();
  add_noise();
  add_form_factors();
  return run_all(argc, argv);
} catch (const std::exception& failure) {
  fmt::print(stderr, "{}\n", failure.what());
  return 1;
}
