#include "simulator/farm/shared_farm.hpp"

#include <cmath>

#include "base/errors.hpp"
#include "simulator/farm/centre_wiring.hpp"
#include "simulator/farm/shared_processes.hpp"
#include "simulator/kernels/kernel_cost.hpp"
#include "simulator/kernels/placement.hpp"

namespace farm {

using base::BadInput;

SceneSize size_of(const renderer::Scene& scene) { return {box_count(scene), object_count(scene)}; }

namespace {

struct SceneBytes {
  SceneBytes(const machine::Model& model, const SceneSize& scene)
      : box(get_bytes(model, "box")),
        object(get_bytes(model, "object")),
        all(scene.boxes * box + scene.objects * object) {}
  std::uint64_t percent(double share) const {
    return static_cast<std::uint64_t>(std::llround(share / 100 * static_cast<double>(all)));
  }
  std::uint64_t box, object, all;
};

void check_percent(const char* key, double percent, const SceneBytes& scene,
                   std::uint64_t largest) {
  if (!(percent > 0 && percent <= 100))
    throw BadInput(fmt::format("{}: found {}, expected more than 0, 100 at most", key, percent));
  if (const auto bytes = scene.percent(percent); bytes < largest)
    throw BadInput(
        fmt::format("{}: found {} % of a scene of {} bytes, a cache of {}, expected at least the "
                    "{} bytes of its largest record",
                    key, percent, scene.all, bytes, largest));
}

void check_farm(const Params& params) {
  check(params);
  check_task(params);
  if (params.cycles_per_host_s)
    throw BadInput(
        "run.cost: found timed, expected counted: a kernel that waits for data ([data]) cannot be "
        "timed, other processes run meanwhile");
  if (params.scene_message > 0)
    throw BadInput(
        fmt::format("farm.scene_message_bytes: found {}, expected 0: workers that read the scene "
                    "through data managers ([data]) are not sent it",
                    params.scene_message));
}

shared_memory::DataParams make_data_params(const SharedParams& data, const SceneBytes& scene) {
  shared_memory::DataParams params;
  params.scheme = data.scheme;
  params.cache_bytes = scene.percent(data.cache_percent);
  params.server_cache_bytes = scene.percent(data.server_cache_percent);
  params.in_path = data.in_path;
  params.waiting_queue = data.waiting_queue;
  params.page_items = data.page_items;
  return params;
}

// The topology with the coordinator before the workers, whose numbers are one higher.
topologies::Topology join_coordinator(const topologies::Topology& workers) {
  topologies::Topology joined;
  joined.name = workers.name;
  joined.processors = workers.processors + 1;
  joined.links.push_back({{0, 0}, {workers.root + 1, free_port(workers, workers.root)}});
  for (auto link : workers.links) {
    ++link.a.processor;
    ++link.b.processor;
    joined.links.push_back(link);
  }
  for (const auto& [ends, count] : workers.switches)
    joined.switches[{ends.first + 1, ends.second + 1}] = count;
  check(joined);
  return joined;
}

// There is room for all that can be on its way: a request or its reply and blocks of each worker.
network::Params make_network_params(const machine::Model& model, const Params& farm,
                                    const SharedParams& data,
                                    const shared_memory::Catalogue& catalogue,
                                    const shared_memory::DataParams& managers, int workers) {
  network::Params params;
  params.method = data.method;
  params.buffers = static_cast<std::size_t>((1 + BLOCKS_OF_WORKER) * workers + 1);
  const renderer::Area block{0, 0, farm.block->width, farm.block->height};
  params.longest = std::max(shared_memory::longest_message(model, catalogue, managers),
                            block_bytes(kernels::record_bytes(model).pixel, block));
  return params;
}

void add_processors(machine::Machine& machine, const Params& params, int workers) {
  const auto& model = machine.model();
  auto& coordinator =
      add_processor(machine, Role::coordinator, database_memory(model, params), Role::coordinator);
  for (int number = 1; number <= workers; ++number)
    add_worker(machine, number, worker_memory(model, params));
  allocate_image(coordinator, params.image);
}

class SharedFarm {
 public:
  SharedFarm(const machine::Model& model, const topologies::Topology& asked,
             const renderer::Scene& scene, const Params& params, const SharedParams& data)
      : params_(params),
        workers_(free_root_port(asked)),
        joined_(join_coordinator(workers_)),
        scene_(scene),
        items_(model, scene),
        data_params_(make_data_params(data, {model, size_of(scene)})),
        machine_(model, model.software.occam_factor),
        progress_(machine_) {
    add_processors(machine_, params, workers_.processors);
    network_.emplace(machine_, make_routing(data.method, joined_, topologies::make_routes(joined_)),
                     make_network_params(model, params, data, items_.catalogue(), data_params_,
                                         workers_.processors));
    memory_.emplace(machine_, *network_, items_.catalogue(), data_params_);
  }

  SharedResult run();

 private:
  void start();
  Result take_result(machine::End end);

  const Params& params_;
  const topologies::Topology workers_, joined_;
  const renderer::Scene& scene_;
  const shared_memory::SceneItems items_;
  const shared_memory::DataParams data_params_;
  machine::Machine machine_;
  std::optional<network::Network> network_;
  std::optional<shared_memory::VirtualMemory> memory_;
  std::optional<WorkerSetup> worker_;
  renderer::Samples samples_;
  Progress progress_;
};

void SharedFarm::start() {
  const auto& model = machine_.model();
  samples_ = renderer::Samples(params_.image.width, params_.image.height);
  worker_.emplace(WorkerSetup{scene_, params_.image, items_, kernels::tree_costs(model),
                              kernels::record_bytes(model).pixel});
  for (int id = 0; id <= workers_.processors; ++id) {
    auto& processor = *machine_.processors()[static_cast<std::size_t>(id)];
    auto& manager = memory_->manager(id);
    if (id == 0)
      kernels::start(processor, "coordination", machine::Priority::low, [this, &manager] {
        coordinate({.blocks = make_blocks(params_.image, *params_.block),
                    .workers = workers_.processors,
                    .cost = {machine_.model(), "central", renderer::op_names()}},
                   manager, samples_, progress_);
      });
    else
      kernels::start(processor, "application", machine::Priority::low,
                     [this, &manager] { work(*worker_, manager); });
  }
}

Result SharedFarm::take_result(machine::End end) {
  Result result = make_result(progress_, end);
  result.samples = std::move(samples_);
  result.topology = workers_;
  for (int id = 1; id <= workers_.processors; ++id)
    result.mean_depth += network_->routing().distance(0, id);
  result.mean_depth /= workers_.processors;
  result.kernel_cycles = worker_->charged;
  result.events = machine_.events();
  return result;
}

SharedResult SharedFarm::run() {
  start();
  SharedResult result;
  result.farm = take_result(observe::run(machine_, params_.watch));
  result.data = memory_->use();
  result.routers = network_->use();
  result.cache_bytes = data_params_.cache_bytes;
  return result;
}

}  // namespace

void check_task(const Params& params) {
  if (!params.block)
    throw BadInput(
        "farm.task: found ray, expected a block of pixels, block:8x8: workers that read the scene "
        "through data managers ([data]) are given no rays");
}

void check(const machine::Model& model, const SceneSize& size, const Params& farm,
           const SharedParams& data) {
  check_farm(farm);
  const SceneBytes scene(model, size);
  if (scene.all == 0) throw BadInput("scene.source: found no objects, expected some ([data])");
  std::uint64_t largest = size.boxes > 0 ? std::max(scene.box, scene.object) : scene.object;
  if (data.scheme == shared_memory::Scheme::pages)
    largest *= static_cast<std::uint64_t>(data.page_items);
  check_percent("data.cache_percent", data.cache_percent, scene, largest);
  if (data.scheme == shared_memory::Scheme::items)
    check_percent("data.server_cache_percent", data.server_cache_percent, scene, largest);
}

SharedResult run_shared_farm(const machine::Model& model, const topologies::Topology& workers,
                             const renderer::Scene& scene, const Params& params,
                             const SharedParams& data) {
  check(model, size_of(scene), params, data);
  return SharedFarm(model, workers, scene, params, data).run();
}

}  // namespace farm
