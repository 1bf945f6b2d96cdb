#include "simulator/programs/data/data_run.hpp"

#include <algorithm>
#include <cmath>

#include "base/random.hpp"
#include "simulator/declare/support.hpp"

namespace programs {

namespace {

using shared_memory::DataManager;
using shared_memory::DataUse;

constexpr int FINISHED = shared_memory::FIRST_FREE_PROCESS, GO_ON = FINISHED + 1;

// What a processor's manager had counted, and when, at the end of a pass.
struct Mark {
  Seconds start{}, end{};
  DataUse use;
};

class Test {
 public:
  Test(const network::Routing& routing, const DataLoad& load, shared_memory::VirtualMemory& memory)
      : load_(load),
        routing_(routing),
        memory_(memory),
        marks_(static_cast<std::size_t>(load.passes),
               std::vector<Mark>(static_cast<std::size_t>(routing.processors()))) {
    double sum = 0;
    for (int k = 0; k < load.items; ++k) wanted_.push_back(sum += std::pow(k + 1, -load.zipf));
  }

  // The process of one processor.
  void live(int id) {
    DataManager& data = memory_.manager(id);
    const bool is_coordinator = id == load_.data.coordinator;
    base::Random random(load_.seed, id);
    for (auto& pass : marks_) {
      Mark& mark = pass[static_cast<std::size_t>(id)];
      mark.start = now();
      if (makes_accesses(id)) make_accesses(data, random);
      this_process().sync();
      mark.end = now();
      if (load_.together && is_coordinator) wait_for_others(data);
      mark.use = data.use();
      if (load_.together && is_coordinator) go_on(data);
      if (load_.together && !is_coordinator) report(data);
    }
    data.serve_for_ever();
  }

  std::vector<DataPass> finish() const {
    std::vector<DataPass> passes;
    int who = 0;
    for (int id = 0; id < routing_.processors(); ++id) who += makes_accesses(id) ? 1 : 0;
    for (std::size_t p = 0; p < marks_.size(); ++p) {
      DataPass& pass = passes.emplace_back();
      Seconds start{INFINITY}, end{};
      for (int id = 0; id < routing_.processors(); ++id) {
        const Mark& mark = marks_[p][static_cast<std::size_t>(id)];
        const DataUse earlier = p > 0 ? marks_[p - 1][static_cast<std::size_t>(id)].use : DataUse{};
        if (id == load_.data.coordinator && load_.together)
          pass.server_seen = mark.use.seen - earlier.seen;
        if (!makes_accesses(id)) continue;
        start = std::min(start, mark.start);
        end = std::max(end, mark.end);
        pass.mean_s += (mark.end - mark.start).value / who;
        pass.use += mark.use;
        pass.use -= earlier;
      }
      pass.time_s = (end - start).value;
    }
    return passes;
  }

 private:
  bool makes_accesses(int id) const {
    return id != load_.data.coordinator || load_.coordinator_too ||
           load_.data.scheme == shared_memory::Scheme::pages;
  }

  void make_accesses(DataManager& data, base::Random& random) const {
    for (int i = 0; i < load_.accesses; ++i) {
      const auto item = std::ranges::upper_bound(wanted_, random.uniform() * wanted_.back());
      data.access({0, std::min(static_cast<int>(item - wanted_.begin()), load_.items - 1)});
    }
  }

  void report(DataManager& data) const {
    network::Message finished;
    finished.to = {load_.data.coordinator, FINISHED};
    data.client().send(finished);
    data.serve();
  }
  void wait_for_others(DataManager& data) const {
    for (int others = routing_.processors() - 1; others > 0; --others) data.serve();
  }
  static void go_on(DataManager& data) {
    network::Message message;
    message.to = network::make_global(GO_ON);
    data.client().send(message);
  }

  const DataLoad& load_;
  const network::Routing& routing_;
  shared_memory::VirtualMemory& memory_;
  std::vector<std::vector<Mark>> marks_;  // by pass and processor
  std::vector<double> wanted_;            // how often an item up to this one is
};

}  // namespace

std::vector<DataPass> run_data(const Setup& setup, const network::Routing& routing,
                               const DataLoad& load) {
  const int n = routing.processors();
  machine::Machine machine(setup.model);
  for (int id = 0; id < n; ++id)
    machine.add_processor(fmt::format("p{}", id), get_bytes(setup.model, "worker_memory"));
  const auto catalogue = shared_memory::make_catalogue(load.items, load.item_bytes);
  auto params = load.network;
  params.longest = longest_message(setup.model, catalogue, load.data);
  network::Network network(machine, routing, params);
  shared_memory::VirtualMemory memory(machine, network, catalogue, load.data);
  Test test(network.routing(), load, memory);
  for (int id = 0; id < n; ++id)
    machine.processors()[id]->start(fmt::format("p{}.application", id), Priority::low,
                                    [&, id] { test.live(id); });
  run_machine(setup, machine);
  return test.finish();
}

}  // namespace programs
