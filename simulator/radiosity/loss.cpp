#include "simulator/radiosity/loss.hpp"

#include <algorithm>

namespace amp {

namespace {

// Of the rounds: what the processor with most to do was charged, and what all were on average.
struct Rounds {
  double most = 0, mean = 0;  // cycles
};

Rounds sum_rounds(const std::vector<std::unique_ptr<Application>>& applications) {
  Rounds sum;
  std::size_t rounds = applications[0]->charged().size();
  for (const auto& application : applications)
    rounds = std::min(rounds, application->charged().size());
  for (std::size_t round = 0; round < rounds; ++round) {
    double most = 0, all = 0;
    for (const auto& application : applications) {
      const auto cycles = static_cast<double>(application->charged()[round].value);
      most = std::max(most, cycles);
      all += cycles;
    }
    sum.most += most;
    sum.mean += all / static_cast<double>(applications.size());
  }
  return sum;
}

}  // namespace

Loss eval_loss(const machine::Model& model, const radiosity::Mesh& mesh, const Params& params,
               const std::vector<std::unique_ptr<Application>>& applications, double time_s) {
  const Rounds rounds = sum_rounds(applications);
  const double time = time_s * model.cpu.clock.value;
  // Points that are lit in a shot.
  const std::size_t centres =
      params.solve.mean == radiosity::Mean::simpson ? mesh.patches.size() : 0;
  std::size_t done = centres;
  for (const auto& application : applications) done += application->node().share.vertices.size();
  const double once =
      static_cast<double>(mesh.vertices.size() + centres) / static_cast<double>(done);
  Loss loss;
  loss.useful = rounds.mean * once / time;
  loss.repeated = rounds.mean * (1 - once) / time;
  loss.unequal = (rounds.most - rounds.mean) / time;
  loss.messages = 1 - rounds.most / time;
  return loss;
}

}  // namespace amp
