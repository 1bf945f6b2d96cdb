#include "simulator/parallel_radiosity/radiosity.hpp"

#include <cmath>

#include "simulator/parallel_radiosity/application.hpp"
#include "simulator/programs/declare/routers.hpp"

namespace parallel_radiosity {

using radiosity::Mesh;

namespace {

std::uint64_t geometry_bytes(const machine::Model& model, const Mesh& mesh) {
  return kernels::scene_bytes(model, mesh.blockers);
}

shared_memory::DataParams data_params(const machine::Model& model, const Mesh& mesh,
                                      const Params& params, int root) {
  shared_memory::DataParams data;
  const double bytes = static_cast<double>(geometry_bytes(model, mesh));
  data.cache_bytes = static_cast<std::uint64_t>(std::llround(params.cache_percent / 100 * bytes));
  data.server_cache_bytes = static_cast<std::uint64_t>(bytes);
  data.coordinator = root;
  return data;
}

// Parameters of the network. The buffers suffice for all messages that can be in transit at the
// same time. For each processor, these are one candidate, one request or reply, and the messages
// with the light of its shared vertices.
network::Params network_params(const Common& common, const shared_memory::DataParams& data,
                               const machine::Model& model, const std::vector<Share>& shares) {
  std::size_t borders = 0;  // number of messages with light of shared vertices
  for (const Share& share : shares)
    for (const Border& border : share.out)
      borders += 1 + border.vertices.size() / MessageBytes::MOST;
  network::Params params;
  params.method = common.params.method;
  params.buffers = 3 * shares.size() + 2 + borders;
  params.longest = common.bytes.longest();
  if (common.items)
    params.longest = std::max(
        params.longest, shared_memory::longest_message(model, common.items->catalogue(), data));
  return params;
}

// Charged seconds, summed over all rounds (shots). In each round, `most` adds the seconds of the
// busiest processor, and `mean` the mean over all processors.
struct Rounds {
  double most = 0, mean = 0;
};

Rounds sum_rounds(const std::vector<std::unique_ptr<Application>>& applications) {
  Rounds sum;
  std::size_t rounds = applications[0]->charged_s().size();
  for (const auto& application : applications)
    rounds = std::min(rounds, application->charged_s().size());
  for (std::size_t round = 0; round < rounds; ++round) {
    double most = 0, all = 0;
    for (const auto& application : applications) {
      const double seconds = application->charged_s()[round];
      most = std::max(most, seconds);
      all += seconds;
    }
    sum.most += most;
    sum.mean += all / static_cast<double>(applications.size());
  }
  return sum;
}

// Computes the fractions of the processors' time, during `time_s` seconds, that are useful or lost.
Loss eval_loss(const radiosity::Mesh& mesh, const Params& params,
               const std::vector<std::unique_ptr<Application>>& applications, double time_s) {
  const Rounds rounds = sum_rounds(applications);
  // A shot lights all vertices. With Simpson's rule, it also lights the centres of patches.
  const std::size_t centres =
      params.solve.mean == radiosity::Mean::simpson ? mesh.patches.size() : 0;
  std::size_t done = centres;
  for (const auto& application : applications) done += application->node().share.vertices.size();
  const double once =
      static_cast<double>(mesh.vertices.size() + centres) / static_cast<double>(done);
  Loss loss;
  loss.useful = rounds.mean * once / time_s;
  loss.repeated = rounds.mean * (1 - once) / time_s;
  loss.unequal = (rounds.most - rounds.mean) / time_s;
  loss.messages = 1 - rounds.most / time_s;
  return loss;
}

class Amp {
 public:
  Amp(const Setup& setup, const Mesh& mesh, const Params& params)
      : mesh_(mesh),
        params_(params),
        kernels_(setup, mesh, params),
        common_{mesh,
                setup,
                params,
                MessageBytes(setup.model, params.solve.sends),
                kernels_,
                {},
                setup.topology.root,
                {setup.model, [](const machine::Model& its) { return MessageWork(its); }}},
        machine_(setup.model, machine::Code::compiled, setup.engine) {
    const auto& [model, topology] = std::tie(setup.model, setup.topology);
    if (params.cache_percent > 0) common_.items.emplace(model, mesh.blockers);
    auto shares = distribute(mesh, topology.processors, params.distribution);
    if (params.exchange) exchange_borders(shares, mesh.vertices.size());
    const auto data = data_params(model, mesh, params, topology.root);
    for (int id = 0; id < topology.processors; ++id) {
      auto& processor = machine_.add_processor(name_of(topology, id, fmt::format("p{}", id)),
                                               get_bytes(setup.model_of(id), "worker_memory"), {},
                                               programs::find_model(setup.others, id));
      kernels::load_program(processor);
    }
    network_.emplace(machine_,
                     make_routing(params.method, topology, topologies::make_routes(topology)),
                     network_params(common_, data, model, shares));
    if (common_.items) memory_.emplace(machine_, *network_, common_.items->catalogue(), data);
    make_nodes(std::move(shares));
  }

  Result run() {
    start();
    return take_result(observe::run(machine_, common_.setup.monitor, make_view()));
  }

 private:
  observe::ControlPanel make_view() {
    observe::ControlPanel view;
    view.gauges = {{"shots", "done", [this] { return static_cast<double>(root_->shots()); }},
                   {"unshot", "share of unsent light in the last picture", [this] {
                      return root_->frames().empty() ? 1 : root_->frames().back().unshot;
                    }}};
    programs::show(view, *network_);
    if (memory_) shared_memory::show(view, *memory_);
    if (!params_.look) return view;
    bitmap_ = params_.look(nullptr);
    view.picture = {bitmap_.width, bitmap_.height, [this] { return &look(); }};
    return view;
  }

  // Returns the picture of the last frame. Draws it only if it is new.
  const std::vector<std::uint8_t>& look() {
    if (root_->frames().size() > frames_looked_at_) {
      frames_looked_at_ = root_->frames().size();
      bitmap_ = params_.look(&root_->frames().back());
    }
    return bitmap_.rgb8;
  }

  void make_nodes(std::vector<Share> shares) {
    const auto& routing = network_->routing();
    for (int id = 0; id < routing.processors(); ++id) {
      Node node;
      node.id = node.parent = id;
      if (id != common_.root)
        node.parent = routing.neighbour(id, routing.port_to(id, common_.root));
      node.share = std::move(shares[id]);
      node.client = &network_->client(id);
      if (memory_) node.manager = &memory_->manager(id);
      allocate(node);
      nodes_.push_back(std::move(node));
    }
    for (const Node& node : nodes_)
      if (node.id != common_.root) ++nodes_[node.parent].children;
  }

  void allocate(const Node& node) {
    auto& processor = *machine_.processors()[node.id];
    const auto& model = processor.model();
    auto& memory = processor.memory();
    const auto room = [&](std::uint64_t count, const char* record, const char* what) {
      memory.allocate(count * get_bytes(model, record), what, {});
    };
    room(node.share.patches.size(), "radiosity_patch", "its patches");
    if (params_.solve.sends == radiosity::Sends::corners)
      room(4 * node.share.patches.size(), "colour", "unsent light at the corners of its patches");
    room(node.share.vertices.size(), "radiosity_vertex", "its vertices");
    std::size_t told = 0;
    for (const Border& border : node.share.in) told += border.vertices.size();
    room(told, "colour", "what other processors send about their patches");
    if (!memory_)
      memory.allocate(geometry_bytes(model, mesh_), "the faces and their hierarchy", {});
    if (node.id == common_.root) room(mesh_.vertices.size(), "colour", "the display's vertices");
  }

  void start() {
    before_ = observe::collect(machine_);
    for (const Node& node : nodes_) {
      auto& processor = *machine_.processors()[node.id];
      if (node.id == common_.root) {
        const auto on_solved = [this] { after_ = observe::collect(machine_); };
        auto root = std::make_unique<Root>(common_, node, nodes_, on_solved);
        root_ = root.get();
        applications_.push_back(std::move(root));
      } else {
        applications_.push_back(std::make_unique<Application>(common_, node));
      }
      kernels::start(processor, "application", machine::Priority::low,
                     [application = applications_.back().get()] { application->run(); });
    }
  }

  Result take_result(machine::End end) {
    Result result;
    result.end = end;
    if (!after_) after_ = observe::collect(machine_);
    result.use = between(before_, *after_);
    result.time_s = result.use.time_s;
    result.shots = root_->shots();
    result.frames = root_->frames();
    result.total_s = result.frames.empty() ? machine_.now().value : result.frames.back().at_s;
    result.loss = eval_loss(mesh_, params_, applications_, result.time_s);
    for (const auto& application : applications_) {
      result.work += application->work();
      result.kernel_cycles += application->kernel_cycles();
      result.vertices_done_max = std::max<std::uint64_t>(result.vertices_done_max,
                                                         application->node().share.vertices.size());
    }
    result.kernels =
        kernels::uses_of({&kernels_.choose, &kernels_.receive, &kernels_.settle, &kernels_.draw});
    if (memory_) result.data = memory_->use();
    result.routers = network_->use();
    result.events = machine_.events();
    return result;
  }

  const Mesh& mesh_;
  const Params& params_;
  Kernels kernels_;
  Common common_;
  machine::Machine machine_;
  std::optional<network::Network> network_;
  std::optional<shared_memory::VirtualMemory> memory_;
  std::vector<Node> nodes_;
  std::vector<std::unique_ptr<Application>> applications_;
  Root* root_ = nullptr;
  renderer::Bitmap bitmap_;  // picture of the last frame, for the live page
  std::size_t frames_looked_at_ = 0;
  observe::Use before_;
  std::optional<observe::Use> after_;
};

}  // namespace

void check(const machine::Model& model, const Mesh& mesh, int processors, const Params& params) {
  check(params.solve.factor);
  base::require(mesh.patches.size() >= static_cast<std::size_t>(processors), "network",
                "found {} processors, expected at most {}, the number of patches of the room",
                processors, mesh.patches.size());
  if (params.cache_percent == 0) return;
  constexpr auto key = "program.cache_percent";
  base::require(params.cache_percent > 0 && params.cache_percent <= 100, key,
                "found {}, expected 0 to 100", params.cache_percent);
  const auto largest = std::max(get_bytes(model, "object"), get_bytes(model, "box"));
  const auto bytes = data_params(model, mesh, params, 0).cache_bytes;
  base::require(bytes >= largest, key,
                "found a cache of {2} bytes ({0} % of a geometry of {1} bytes), expected at least "
                "{3} bytes, its largest record",
                params.cache_percent, geometry_bytes(model, mesh), bytes, largest);
}

Result run_radiosity(const Setup& setup, const Mesh& mesh, const Params& params) {
  check(setup.model, mesh, setup.topology.processors, params);
  return Amp(setup, mesh, params).run();
}

}  // namespace parallel_radiosity
