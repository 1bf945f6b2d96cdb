#include "simulator/farm/farm.hpp"

#include <bit>

#include "base/errors.hpp"
#include "simulator/farm/centre_wiring.hpp"
#include "simulator/farm/worker.hpp"
#include "simulator/kernels/placement.hpp"

namespace farm {

using machine::Machine;
using machine::Processor;

namespace {

void check_area(renderer::Params image, const renderer::Area& area) {
  image.area = area;
  check(image);
}

// A block's rays never meet the database's priorities.
void check_block(const Params& params) {
  if (!params.block) return;
  const Block& block = *params.block;
  if (block.width < 1 || block.height < 1)
    throw base::BadInput(
        fmt::format("farm.task: found a block of {}x{} pixels, expected 1x1 or more", block.width,
                    block.height));
  if (params.stages != std::vector<Limits>(1) || !params.script.empty())
    throw base::BadInput(
        "farm.task: found a block, expected ray: stages and orders choose among rays");
}

}  // namespace

void check(const Params& params) {
  check(params.image);
  if (params.max_cell < 1 || !std::has_single_bit(static_cast<unsigned>(params.max_cell)))
    throw base::BadInput(
        fmt::format("farm.max_cell: found {}, expected a power of two", params.max_cell));
  check_block(params);
  if (params.stages.empty()) throw base::BadInput("stages: at least one is needed");
  for (const Limits& limits : params.stages) check_area(params.image, limits.area);
  for (const Order& order : params.script)
    if (const auto* limits = std::get_if<Limits>(&order.command.content))
      check_area(params.image, limits->area);
  for (std::size_t i = 1; i < params.script.size(); ++i)
    if (params.script[i].at < params.script[i - 1].at)
      throw base::BadInput(fmt::format("order {}: its time, {} s, is before the last one's", i + 1,
                                       params.script[i].at.value));
}

namespace {

// Takes the memory of the worker's copy of the scene.
void load_scene(Processor& worker, const renderer::Scene& scene) {
  const auto& model = worker.model();
  auto& memory = worker.memory();
  memory.allocate(object_count(scene) * get_bytes(model, "object"), "the scene's objects",
                  worker.now());
  memory.allocate(box_count(scene) * get_bytes(model, "box"), "the scene's hierarchy",
                  worker.now());
}

Kernel make_kernel(const machine::Model& model, const renderer::Scene& scene,
                   const Params& params) {
  const auto& host = params.cycles_per_host_s;
  return {scene, params.image,
          kernels::KernelCost(kernels::intersection_costs(model), host, params.profile),
          kernels::KernelCost(kernels::tree_costs(model), host, params.profile),
          kernels::record_bytes(model)};
}

}  // namespace

Result run_farm(const machine::Model& model, const topologies::Topology& topology,
                const renderer::Scene& scene, const Params& params) {
  check(params);
  Machine machine(model, model.software.occam_factor);
  Wires wires;
  Centre centre(machine, scene, params);
  Kernel kernel = make_kernel(model, scene, params);
  const Workers workers =
      wire_workers(wires, machine, topology, centre.coordinator(), worker_memory(model, params));
  for (std::size_t id = 0; id < workers.processors.size(); ++id) {
    load_scene(*workers.processors[id], scene);
    start_worker(wires, workers, id, kernel);
  }
  centre.start(wires, workers);

  Result result = centre.take_result(observe::run(machine, params.watch));
  result.topology = workers.topology;
  result.mean_depth = workers.mean_depth;
  result.events = machine.events();
  result.kernel_host_s = kernel.ray.host_s() + kernel.block.host_s();
  result.kernel_cycles = kernel.ray.charged() + kernel.block.charged();
  return result;
}

std::uint64_t worker_memory(const machine::Model& model, const Params& params) {
  return params.worker_memory.value_or(get_bytes(model, "worker_memory"));
}

std::uint64_t database_memory(const machine::Model& model, const Params& params) {
  return params.database_memory.value_or(get_bytes(model, "database_memory"));
}

Processor& add_processor(Machine& machine, const std::string& name, std::uint64_t memory,
                         const char* role) {
  Processor& processor = machine.add_processor(name, memory, role);
  kernels::load_program(processor);
  return processor;
}

Processor& add_worker(Machine& machine, int number, std::uint64_t memory) {
  return add_processor(machine, fmt::format("worker{}", number), memory, Role::worker);
}

void allocate_image(Processor& display, const renderer::Params& image) {
  display.memory().allocate(get_bytes(display.model(), "pixel") *
                                static_cast<std::uint64_t>(image.width) *
                                static_cast<std::uint64_t>(image.height),
                            "the image", display.now());
}

Result make_result(Progress& progress, machine::End end) {
  if (end != machine::End::done) progress.cut();
  Result result;
  result.end = end;
  result.rays = progress.rays;
  result.time_s = (progress.ended - progress.begun).value;
  result.setup_s = progress.begun.value;
  result.tasks = progress.tasks;
  result.peak_tasks_in_farm = progress.peak_tasks_in_farm;
  result.drain_s = (progress.ended - progress.last_task).value;
  result.use = between(progress.before, progress.after);
  return result;
}

}  // namespace farm
