// How fast the machine simulates, against the same programs written directly on SimGrid.
#include <deque>
#include <memory>

#include "experiments/benchmarks/raw_simgrid.hpp"
#include "simulator/machine/machine.hpp"
#include "simulator/occam/alt.hpp"
#include "simulator/occam/process.hpp"

using namespace benchmarks;
using namespace occam;
using machine::Machine;
using machine::Model;
using machine::Priority;

namespace {

constexpr std::uint64_t MEMORY = 1 << 20;  // bytes, of every processor
constexpr int RUNS = 3, MEETINGS = 200'000, PREEMPTIONS = 50'000;
constexpr std::int64_t PERIOD_US = 100;  // between pre-emptions
constexpr Cycles INTERRUPTION{1000};

struct Message {
  int to = 0;
  static constexpr std::uint64_t bytes() { return MESSAGE_BYTES; }
};

Sample run(Machine& machine, std::uint64_t count) {
  const double cpu_s = time_of([&] { machine.run(); });
  return {count, cpu_s, machine.now() / machine::Seconds{1}};
}

void relay(int id, Channel<Message>* before, Channel<Message>* after) {
  Message message{id};
  for (int i = 0; i < LINE_MESSAGES; ++i) {
    if (before) in(*before, message);
    if (after) out(*after, message);
  }
}

// A line of processors; each but the last sends to the next, each but the first receives.
Sample line(const Model& model) {
  Machine machine(model);
  std::deque<Channel<Message>> channels;
  for (int id = 0; id <= LINE_HOPS; ++id) machine.add_processor(fmt::format("p{}", id), MEMORY);
  const auto& processors = machine.processors();
  for (int id = 0; id < LINE_HOPS; ++id) {
    machine.connect(*processors[id], *processors[id + 1]);
    channels.emplace_back("channel", machine.link(*processors[id], *processors[id + 1]));
  }
  for (int id = 0; id <= LINE_HOPS; ++id)
    processors[id]->start("relay", Priority::high, [&, id] {
      relay(id, id > 0 ? &channels[id - 1] : nullptr, id < LINE_HOPS ? &channels[id] : nullptr);
    });
  return run(machine, std::uint64_t{LINE_MESSAGES} * LINE_HOPS);
}

// A node of the mesh: a receiver for each incoming link, a sender for each outgoing one, which
// takes from the receivers and the node's own source in turn.
struct Node {
  static constexpr int SOURCE = DIRECTIONS;  // it, and the receivers by their link's direction
  std::array<Channel<Message>*, DIRECTIONS> from{}, to{};  // links; null at the edge
  std::array<std::array<std::unique_ptr<Channel<Message>>, DIRECTIONS>, SOURCE + 1> within;
};

void receiver(int id, const Node& node, int direction, int messages) {
  Message message;
  for (; messages > 0; --messages) {
    in(*node.from[direction], message);
    if (message.to != id) out(*node.within[direction][route(id, message.to)], message);
  }
}

void source(int id, const Node& node, const std::vector<int>& destinations) {
  for (const int to : destinations) out(*node.within[Node::SOURCE][route(id, to)], Message{to});
}

void sender(const Node& node, int direction, int messages) {
  std::vector<Channel<Message>*> inputs;
  for (const auto& row : node.within)
    if (row[direction]) inputs.push_back(row[direction].get());
  Message message;
  for (std::size_t favourite = 0; messages > 0; --messages) {
    favourite = fair_alt(favourite, std::span<Channel<Message>* const>(inputs), message) + 1;
    out(*node.to[direction], message);
  }
}

Sample mesh(const Model& model, const Traffic& traffic) {
  Machine machine(model);
  std::deque<Channel<Message>> links;
  std::vector<Node> nodes(NODES);
  for (int id = 0; id < NODES; ++id) machine.add_processor(fmt::format("p{}", id), MEMORY);
  const auto& processors = machine.processors();
  for (int id = 0; id < NODES; ++id)
    for (int d = 0; d < DIRECTIONS; ++d) {
      const int other = neighbour(id, d);
      if (other < id) continue;
      machine.connect(*processors[id], *processors[other]);
      const auto back = opposite(d);
      nodes[id].to[d] = nodes[other].from[back] =
          &links.emplace_back("link", machine.link(*processors[id], *processors[other]));
      nodes[other].to[back] = nodes[id].from[d] =
          &links.emplace_back("link", machine.link(*processors[other], *processors[id]));
    }
  for (int id = 0; id < NODES; ++id) {
    Node& node = nodes[id];
    machine::Processor& processor = *processors[id];
    for (int d = 0; d < DIRECTIONS; ++d) {
      if (!node.to[d]) continue;
      for (int from = 0; from <= Node::SOURCE; ++from)
        if (from != d && (from == Node::SOURCE || node.from[from]))
          node.within[from][d] = std::make_unique<Channel<Message>>("within");
    }
    for (int d = 0; d < DIRECTIONS; ++d) {
      if (!node.to[d]) continue;
      processor.start("receiver", Priority::high, [&, id, d] {
        receiver(id, node, d, traffic.leaving[neighbour(id, d)][opposite(d)]);
      });
      processor.start("sender", Priority::high,
                      [&, id, d] { sender(node, d, traffic.leaving[id][d]); });
    }
    processor.start("source", Priority::high,
                    [&, id] { source(id, node, traffic.destinations[id]); });
  }
  return run(machine, traffic.hops);
}

Sample rendezvous(const Model& model) {
  Machine machine(model);
  auto& processor = machine.add_processor("p", MEMORY);
  Channel<Signal> channel("channel");
  processor.start("out", Priority::high, [&] {
    for (int i = 0; i < MEETINGS; ++i) out(channel, Signal{});
  });
  processor.start("in", Priority::high, [&] {
    for (int i = 0; i < MEETINGS; ++i) in(channel);
  });
  return run(machine, MEETINGS);
}

Sample preemptions(const Model& model) {
  Machine machine(model);
  auto& processor = machine.add_processor("p", MEMORY);
  processor.start("low", Priority::low, [&] {
    this_process().charge(
        {static_cast<std::int64_t>(model.cpu.clock.value * 1e-6) * PERIOD_US * PREEMPTIONS});
    this_process().sync();
  });
  processor.start("high", Priority::high, [] {
    for (int i = 1; i <= PREEMPTIONS; ++i) {
      wait_until(i * PERIOD_US);
      this_process().charge(INTERRUPTION);
    }
  });
  Sample sample = run(machine, 0);
  sample.count = processor.use().preemptions;
  return sample;
}

void report(const char* what, const Sample& ours, const Sample& raw, Ratios& ratios) {
  fmt::print("{:32} {:9} {:9.0f} {:9.0f} {:8.2f} {:11.4f} {:9.4f}\n", what, ours.count,
             1e-3 * ours.rate(), 1e-3 * raw.rate(), ours.rate() / raw.rate(), ours.simulated_s,
             raw.simulated_s);
  ratios.add(fmt::format("{}: tlab / raw SimGrid", what), ours.rate() / raw.rate());
}

}  // namespace

int main() try {
  const Model model = machine::load_model("t805-25");
  const Traffic traffic = make_traffic();
  const auto best = [](auto&& run) { return best_of(RUNS, [&] { return in_child(run); }); };
  fmt::print("Simulated events a second of host CPU time, one thread, best of {}\n{}\n\n", RUNS,
             host());
  fmt::print("{:32} {:>9} {:>9} {:>9} {:>8} {:>11} {:>9}\n", "", "count", "tlab k/s", "raw k/s",
             "tlab/raw", "simulated s", "raw s");
  Ratios ratios;
  report("hops of 80 bytes, line of 4", best([&] { return line(model); }),
         best([&] { return raw_line(model); }), ratios);
  report("hops of 80 bytes, 8 x 8 mesh", best([&] { return mesh(model, traffic); }),
         best([&] { return raw_mesh(model, traffic); }), ratios);
  report("soft-channel rendezvous", best([&] { return rendezvous(model); }),
         best([&] { return raw_rendezvous(model, MEETINGS); }), ratios);
  report("pre-emptions", best([&] { return preemptions(model); }), best([&] {
           return raw_preemptions(model, PREEMPTIONS, 1e-6 * PERIOD_US,
                                  static_cast<double>(INTERRUPTION.value));
         }),
         ratios);
  ratios.print();
} catch (const std::exception& failure) {
  fmt::print(stderr, "{}\n", failure.what());
  return 1;
}
