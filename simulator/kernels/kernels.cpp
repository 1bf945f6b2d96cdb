#include "simulator/kernels/kernels.hpp"

namespace kernels {

void load_program(machine::Processor& processor) {
  processor.memory().allocate(get_bytes(processor.model(), "program"), "the program",
                              processor.now());
}

machine::Process& start(machine::Processor& on, const char* name, machine::Priority priority,
                        machine::Process::Body body) {
  return on.start(fmt::format("{}.{}", on.name(), name), priority, std::move(body));
}

RecordBytes record_bytes(const machine::Model& model) {
  const auto get = [&](const char* name) {
    return static_cast<std::uint32_t>(get_bytes(model, name));
  };
  return {get("ray"), get("hit"), get("pixel")};
}

MessageCosts message_costs(const machine::Model& model) {
  return {get_compiled(model, "message_made"), get_compiled(model, "message_read")};
}

std::uint64_t scene_bytes(const machine::Model& model, const renderer::Scene& scene) {
  return object_count(scene) * get_bytes(model, "object") +
         box_count(scene) * get_bytes(model, "box");
}

std::uint64_t texture_bytes(const machine::Model& model, const renderer::Scene& scene) {
  std::uint64_t texels = 0;
  for (const auto& pyramid : scene.pyramids) texels += texel_count(pyramid);
  return texels * get_bytes(model, "texel");
}

std::vector<KernelUse> uses_of(std::initializer_list<const KernelCost*> kernels) {
  std::vector<KernelUse> uses;
  for (const auto* kernel : kernels)
    if (auto use = kernel->use(); use.calls > 0) uses.push_back(std::move(use));
  return uses;
}

std::vector<std::string> note_short(const std::vector<KernelUse>& uses) {
  std::vector<std::string> notes;
  const double interval_us = 1e6 * clock_interval_s();
  for (const auto& use : uses)
    if (use.is_short)
      notes.push_back(fmt::format(
          "timed: the kernel \"{0}\" ({1} calls of {2:.3g} us) is too short for the host's clock "
          "(resolution {5:.2g} us): found {3:.3g} us for the longest batch of calls, expected "
          "{4:.3g} us; each call was repeated with its inputs, so its cost may be up to a third "
          "too low",
          use.name, use.calls, 1e6 * use.host_s / static_cast<double>(use.calls),
          1e6 * use.longest_batch_s, KernelTimer::LEAST_INTERVALS * interval_us, interval_us));
  return notes;
}

KernelUse KernelCost::use() const {
  KernelUse use = use_;
  if (timed_) {
    use.is_short = timed_->timer.is_short();
    use.longest_batch_s = timed_->timer.longest_batch_s();
  }
  return use;
}

machine::Cycles KernelCost::note(machine::Cycles counted, machine::Cycles charged, double host_s) {
  ++use_.calls;
  use_.counted += counted;
  use_.charged += charged;
  charged_s_ += machine::this_process().processor().duration(charged);
  use_.host_s += host_s;
  return charged;
}

// Records the host time of one measured call, which stands for all calls since the previous
// measured one. If calls are short compared with reading the clock, only one in 17 is measured.
// This period is a prime number, so a pattern in the kinds of rays is unlikely to have the same
// period.
void KernelCost::note_profile(double start_s) {
  constexpr std::uint64_t SAMPLED = 17;
  const double interval_s = clock_interval_s();
  profile_s_ += static_cast<double>(each_of_) * std::max(0.0, host_cpu_s() - start_s - interval_s);
  profiled_ += each_of_;
  const double mean_s = profile_s_ / static_cast<double>(profiled_);
  each_of_ = mean_s < KernelTimer::LEAST_INTERVALS * interval_s ? SAMPLED : 1;
  next_profiled_ = use_.calls + each_of_;
}

machine::OperationCosts intersection_costs(const machine::Model& model) {
  return {model, "intersection", renderer::op_names()};
}

machine::OperationCosts tree_costs(const machine::Model& model) {
  const auto first_of_shading = static_cast<std::size_t>(renderer::Op::surface_shaded);
  auto costs = intersection_costs(model);
  costs.replace_from(first_of_shading, central_costs(model));
  return costs;
}

machine::OperationCosts central_costs(const machine::Model& model) {
  return {model, "central", renderer::op_names()};
}

machine::Cycles central_cost(const machine::Model& model, std::string_view operation) {
  return machine::OperationCosts(model, "central",
                                 {&operation, 1})(std::array<std::uint64_t, 1>{1});
}

}  // namespace kernels
