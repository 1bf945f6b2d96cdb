// The results router of a worker, which merges results from several inputs (thesis, figure 4.12).
#include <gtest/gtest.h>

#include <array>

#include "simulator/farm/worker.hpp"
#include "tests/support/lab.hpp"

namespace farm {
namespace {

using machine::Priority;
using occam::isolated_numbers, occam::Lab, occam::Numbers, occam::Processor, occam::compute;

constexpr int WAYS = 4, ROUNDS = 6;

// Runs the results router. Each input sends its results as fast as possible, then a Stop. Returns
// one number for each output, in order: for a result, the number of the input that sent it; for a
// Stop, -1.
Numbers run_results_router() {
  return isolated_numbers([] {
    Lab lab;
    Processor& cpu = lab.cpu();
    std::deque<Channel<Answer>> channels;
    std::vector<Channel<Answer>*> inputs;
    for (int k = 0; k < WAYS; ++k)
      inputs.push_back(&channels.emplace_back(fmt::format("in {}", k)));
    auto& output = channels.emplace_back("out");
    for (int k = 0; k < WAYS; ++k)
      cpu.start(fmt::format("way {}", k), Priority::high, [&inputs, k] {
        Intersection found{};
        found.ray.sample = static_cast<std::uint32_t>(k);
        for (int i = 0; i < ROUNDS; ++i) out(*inputs[static_cast<std::size_t>(k)], Answer{found});
        out(*inputs[static_cast<std::size_t>(k)], Answer{Stop{}});
      });
    cpu.start("router", Priority::high, [&] { results_router(inputs, output); });
    Numbers found;
    cpu.start("reader", Priority::low, [&] {
      for (bool active = true; active;) {
        const Answer answer = output.in();
        active = !answer.stop();
        const auto* hit = std::get_if<Intersection>(&answer.content);
        found.push_back(hit ? static_cast<double>(hit->ray.sample) : -1);
        compute(10'000);  // after this time, a result is waiting at every input
      }
    });
    lab.machine.run();
    return found;
  });
}

TEST(ResultsRouter, ServesItsInputsInTurnsAndStopsWithTheLast) {
  const Numbers found = run_results_router();
  ASSERT_EQ(found.size(), WAYS * ROUNDS + 1u);
  EXPECT_EQ(found.back(), -1);
  for (std::size_t at = 0; at < WAYS * ROUNDS; ++at)
    EXPECT_EQ(found[at], found[at % WAYS]) << "result " << at;
  Numbers first(found.begin(), found.begin() + WAYS);
  std::ranges::sort(first);
  EXPECT_EQ(first, (Numbers{0, 1, 2, 3}));
}

}  // namespace
}  // namespace farm
