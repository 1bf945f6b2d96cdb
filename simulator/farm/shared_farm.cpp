#include "simulator/farm/shared_farm.hpp"

#include "simulator/farm/wiring.hpp"
#include "simulator/occam/case_of.hpp"
#include "simulator/programs/declare/routers.hpp"
#include "simulator/shared_memory/scene_items.hpp"

namespace farm {

using network::Address;
using network::Message;
using occam::case_of;
using occam::this_process;
using shared_memory::DataManager;

namespace {

// Process number of the farm in network addresses, and the contents of the farm's messages.
constexpr int FARM_PROCESS = shared_memory::FIRST_FREE_PROCESS;
using FarmMessage = std::variant<Stop, renderer::Area, renderer::Block>;

// Number of blocks that a worker has at a time: one being rendered and one waiting.
constexpr int BLOCKS_OF_WORKER = 2;

void send(DataManager& manager, Address to, FarmMessage content, std::uint64_t bytes) {
  manager.client().send(network::make_message(FARM_PROCESS, to, bytes, std::move(content)));
}

// Length in bytes of the message that carries a rendered block.
std::uint64_t block_bytes(std::uint32_t pixel_bytes, const renderer::Area& area) {
  return BLOCK_BYTES + std::uint64_t{pixel_bytes} * static_cast<std::uint64_t>(area.width) *
                           static_cast<std::uint64_t>(area.height);
}

void check_farm(const Params& params) {
  check(params);
  check_task(params);
  if (params.scene_message > 0)
    base::refuse("farm.scene_message_bytes",
                 "found {}, expected 0: with [data], workers read the scene through data managers",
                 params.scene_message);
}

// Adds the coordinator as processor 0. The numbers of the workers increase by one.
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

// Parameters of the network. The routers' buffers hold all messages that can be in transit at the
// same time. For each worker, these are one request or one reply, and the blocks of this worker.
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

void add_processors(machine::Machine& machine, const Setup& setup, const Params& params,
                    const topologies::Topology& workers) {
  const auto& model = machine.model();
  auto& coordinator = add_processor(machine, to_string(Role::coordinator),
                                    database_memory(model, params), Role::coordinator);
  for (int id = 0; id < workers.processors; ++id) add_worker(machine, workers, id, setup, params);
  allocate_image(coordinator, params.image);
}

class SharedFarm {
 public:
  SharedFarm(const Setup& setup, const renderer::Scene& scene, const Params& params,
             const SharedParams& data)
      : setup_(setup),
        params_(params),
        workers_(free_root_port(setup.topology)),
        joined_(join_coordinator(workers_)),
        scene_(scene),
        items_(setup.model, scene),
        data_params_(make_data_params(setup.model, ray_tracing::size_of(scene), data)),
        machine_(setup.model, machine::Code::compiled, setup.engine),
        pixel_bytes_(kernels::record_bytes(setup.model).pixel),
        block_cost_("block", {setup.model, &kernels::tree_costs}, setup.cycles_per_host_s),
        progress_(machine_),
        visualisation_(
            make_visualisation(setup, scene, params, progress_, [this] { return charged_; })) {
    add_processors(machine_, setup, params, workers_);
    network_.emplace(machine_, make_routing(data.method, joined_, topologies::make_routes(joined_)),
                     make_network_params(setup.model, params, data, items_.catalogue(),
                                         data_params_, workers_.processors));
    memory_.emplace(machine_, *network_, items_.catalogue(), data_params_);
  }

  SharedResult run() {
    start();
    SharedResult result;
    result.farm = take_result(observe::run(machine_, setup_.monitor, make_view()));
    add_workers(result.farm, setup_.topology, workers_, done_);
    result.shared = {memory_->use(), network_->use(), data_params_.cache_bytes,
                     workers_.processors * result.farm.time_s};
    return result;
  }

 private:
  void start() {
    for (int id = 0; id <= workers_.processors; ++id) {
      auto& processor = *machine_.processors()[id];
      auto& manager = memory_->manager(id);
      if (id == 0)
        coordination_ =
            kernels::start(processor, "coordination", machine::Priority::low, [this, &manager] {
              coordinate(manager);
            }).id();
      else
        kernels::start(processor, "application", machine::Priority::low,
                       [this, &manager] { work(manager); });
    }
  }

  // Distributes blocks, adds results to the image, and meanwhile serves scene data. If there is no
  // work, waits for a message instead of polling every idle_period.
  void coordinate(DataManager& manager) {
    progress_.begin();
    const auto blocks = make_blocks(params_.image, *params_.block);
    std::size_t next = 0, in_farm = 0;
    const auto feed = [&](int worker) {
      if (next == blocks.size()) return;
      send(manager, {worker, FARM_PROCESS}, blocks[next++], BLOCK_BYTES);
      progress_.note_task(++in_farm);
    };
    for (int block = 0; block < BLOCKS_OF_WORKER; ++block)
      for (int worker = 1; worker <= workers_.processors; ++worker) {
        manager.look();
        feed(worker);
      }
    while (in_farm > 0) {
      const Message message = manager.serve_at_once();
      const auto& block = std::get<renderer::Block>(network::read<FarmMessage>(message));
      --in_farm;
      ++done_[message.from.processor];
      feed(message.from.processor);
      visualisation_.note();
      progress_.rays += block.rays;
      visualisation_.rays = progress_.rays.total();
      visualisation_.cost(visualisation_.picture, visualisation_.scratch,
                          [kept = message.contents, &block](FrameBuffer& to, renderer::Work& work) {
                            to.add(block, work);
                          });
    }
    progress_.end();
    send(manager, network::make_global(FARM_PROCESS), Stop{}, TAG_BYTES);
  }

  // Renders blocks until it receives Stop.
  void work(DataManager& manager) {
    for (bool active = true; active;) {
      const Message message = manager.serve_at_once();
      case_of(
          network::read<FarmMessage>(message),
          [&](const renderer::Area& area) {
            send(manager, {message.from.processor, FARM_PROCESS}, render(manager, area),
                 block_bytes(pixel_bytes_, area));
          },
          [&](const auto&) { active = false; });
    }
  }

  // Renders a block, whose sums occupy the worker's memory while it is rendered.
  renderer::Block render(DataManager& manager, const renderer::Area& area) {
    return kernels::with_memory(block_bytes(pixel_bytes_, area), "a block of pixels", [&] {
      const double scale = block_cost_.eval_scale(
          block_scratch_, kernels::block_kernel(scene_, params_.image, area));
      shared_memory::SceneReader reader(items_, manager, block_cost_.counted(), scale);
      auto block = render_block(scene_, params_.image, area, &reader);
      reader.charge(block.work);
      charged_ += reader.charged();
      return block;
    });
  }

  observe::ControlPanel make_view() {
    auto view = farm::make_view(visualisation_);
    for (int id = 1; id <= workers_.processors; ++id) view.network.push_back(id);
    shared_memory::show(view, *memory_);
    programs::show(view, *network_);
    return view;
  }

  Result take_result(machine::End end) {
    Result result = make_result(progress_, visualisation_, end);
    result.coordination = coordination_;
    for (int id = 1; id <= workers_.processors; ++id)
      result.mean_depth += network_->routing().distance(0, id);
    result.mean_depth /= workers_.processors;
    result.kernel_cycles = charged_;
    result.kernels = kernels::uses_of({&block_cost_, &visualisation_.cost});
    result.events = machine_.events();
    return result;
  }

  const Setup& setup_;
  const Params& params_;
  const topologies::Topology workers_, joined_;
  const renderer::Scene& scene_;
  const shared_memory::SceneItems items_;
  const shared_memory::DataParams data_params_;
  machine::Machine machine_;
  std::optional<network::Network> network_;
  std::optional<shared_memory::VirtualMemory> memory_;
  const std::uint32_t pixel_bytes_;
  kernels::KernelCost block_cost_;
  machine::Cycles charged_{};  // cycles charged for all blocks
  renderer::BlockBuffer block_scratch_;
  Progress progress_;
  Visualisation visualisation_;
  machine::ProcessId coordination_ = 0;
  std::map<int, std::uint64_t> done_;  // number of tasks, by processor
};

}  // namespace

void check_task(const Params& params) {
  if (!params.block)
    base::refuse(
        "farm.task",
        "found ray, expected a block of pixels such as block:8x8: with [data], tasks are blocks");
}

void check(const machine::Model& model, const ray_tracing::SceneSize& scene, const Params& farm,
           const SharedParams& data) {
  check_farm(farm);
  check_data(model, scene, data);
}

SharedResult run_shared_farm(const Setup& setup, const renderer::Scene& scene, const Params& params,
                             const SharedParams& data) {
  check(setup.model, ray_tracing::size_of(scene), params, data);
  return SharedFarm(setup, scene, params, data).run();
}

}  // namespace farm
