#include "simulator/kernels/kernels.hpp"

#include <cmath>
#include <ctime>

namespace kernels {

void load_program(machine::Processor& processor) {
  processor.memory().allocate(get_bytes(processor.model(), "program"), "the program",
                              processor.now());
}

void start(machine::Processor& on, const char* name, machine::Priority priority,
           machine::Process::Body body) {
  on.start(fmt::format("{}.{}", on.name(), name), priority, std::move(body));
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

double host_cpu_s() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

void KernelCost::charge(double host_s, const renderer::Work& work) {
  const auto cycles = cycles_per_host_s_
                          ? machine::Cycles{std::llround(host_s * *cycles_per_host_s_)}
                          : counted_(work.counts);
  host_s_ += host_s;
  charged_ += cycles;
  machine::this_process().charge(cycles);
}

machine::OperationCosts intersection_costs(const machine::Model& model) {
  return {model, "intersection", renderer::op_names()};
}

machine::OperationCosts tree_costs(const machine::Model& model) {
  const auto first_of_shading = static_cast<std::size_t>(renderer::Op::surface_shaded);
  auto costs = intersection_costs(model);
  const machine::OperationCosts central(model, "central", renderer::op_names());
  costs.replace_from(first_of_shading, central);
  return costs;
}

}  // namespace kernels
