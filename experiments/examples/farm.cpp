// A farm on any topology, a template for other tasks. Tasks go down a spanning tree, and results
// come up. Each processor has one sender for its worker, and one for each child:
//                +--------+ ready  +--------+                +--------+
//   parent ----->| router |<-------| sender |---> worker --->| merger |----> parent
//                |        |------->|        |   children --->|        |
//                +--------+  task  +--------+                +--------+
#include <fmt/format.h>

#include <deque>

#include "simulator/occam/alt.hpp"
#include "topologies/make/generators.hpp"
#include "topologies/route/routes.hpp"

using namespace occam;
using machine::Priority;

// A task, its computation and its cost: replace these by your own. A task also carries its result.
constexpr int TASKS = 200;
struct Task {
  int number = -1, terms = 0, sum = 0;
  static constexpr std::uint64_t bytes() { return 12; }
  bool stop() const { return number < 0; }  // a negative number marks the end of the tasks
};
Task make_task(int i) { return {i < TASKS ? i : -1, 100 + i * 37 % 200}; }
Cycles work(Task& task, const machine::Model& model) {
  for (int i = 1; i <= task.terms; ++i) task.sum += i * i;
  return task.terms * (get_instruction(model, "integer_mul") + get_instruction(model, "lend"));
}
using Tasks = Channel<Task>;
using Readies = Channel<Signal>;

void worker(Tasks& tasks, Tasks& results) {
  for (Task task; in(tasks, task), !task.stop(); out(results, task))
    charge(work(task, this_process().processor().model()));
  out(results, Task{});
}

void sender(Readies& ready, Tasks& tasks, Tasks& way) {
  for (Task task{0}; !task.stop();) out(ready, Signal{}), in(tasks, task), out(way, task);
}

void router(Tasks& parent, std::span<Readies* const> ready, std::span<Tasks* const> tasks) {
  Signal signal;
  // The worker on this processor is the first guard and has priority over the children.
  for (Task task; in(parent, task), !task.stop();) out(*tasks[fair_alt(0, ready, signal)], task);
  for (std::size_t i = 0; i < ready.size(); ++i) in(*ready[i]), out(*tasks[i], Task{});
}

void merger(std::span<Tasks* const> inputs, Tasks& parent) {
  std::size_t turn = 0, active = inputs.size();
  for (Task result; active > 0; turn = (turn + 1) % inputs.size()) {
    fair_alt(turn, inputs, result);
    if (!result.stop() || --active == 0) out(parent, result);
  }
}

int main(int argc, char** argv) {
  const auto topology = topologies::make_topology(argc > 1 ? argv[1] : "mesh:3x3");
  const auto tree = topologies::make_spanning_tree(topology, topology.root);
  machine::Machine machine(machine::load_model("t805-25"));
  const auto& cpus = machine.processors();
  for (int i = 0; i < topology.processors; ++i) machine.add_processor(std::to_string(i), 1 << 20);
  for (auto [a, b] : topology.links) machine.connect(*cpus[a.processor], *cpus[b.processor]);
  std::deque<Tasks> down, up, soft;  // down[i]: to processor i; up[i]: to its parent
  std::deque<Readies> signals;
  for (int i = 0, parent; i < topology.processors; ++i)
    if ((parent = tree.parent[i]) < 0)
      down.emplace_back("tasks"), up.emplace_back("results");
    else
      down.emplace_back("tasks", machine.link(*cpus[parent], *cpus[i])),
          up.emplace_back("results", machine.link(*cpus[i], *cpus[parent]));
  for (int i = 0; i < topology.processors; ++i) {
    std::vector<Tasks*> ways{&soft.emplace_back("worker.in")}, tasks;
    std::vector<Tasks*> inputs{&soft.emplace_back("worker.out")};
    std::vector<Readies*> ready;
    for (int child : tree.children[i]) ways.push_back(&down[child]), inputs.push_back(&up[child]);
    for (Tasks* way : ways) {
      auto* r = ready.emplace_back(&signals.emplace_back("ready"));
      auto* t = tasks.emplace_back(&soft.emplace_back("sender.in"));
      cpus[i]->start("sender", Priority::high, [=] { sender(*r, *t, *way); });
    }
    cpus[i]->start("worker", Priority::low, [=] { worker(*ways[0], *inputs[0]); });
    cpus[i]->start("router", Priority::high, [=, &from = down[i]] { router(from, ready, tasks); });
    cpus[i]->start("merger", Priority::high, [=, &to = up[i]] { merger(inputs, to); });
  }
  std::vector<int> returns(TASKS);
  Cycles alone{};  // time of all tasks on one processor without a farm
  cpus[topology.root]->start("feed", Priority::high, [&] {
    for (int i = 0; i <= TASKS; ++i) out(down[topology.root], make_task(i));
  });
  cpus[topology.root]->start("collect", Priority::high, [&] {
    for (Task task; in(up[topology.root], task), !task.stop(); ++returns.at(task.number))
      alone += work(task, machine.model());
  });
  machine.run();
  if (returns != std::vector(TASKS, 1)) return fmt::print("tasks were lost or doubled\n"), 1;
  fmt::print("{}: {:.1f} us, speed-up {:.2f}\n", topology.name, 1e6 * machine.now().value,
             alone / machine.model().cpu.clock / machine.now());
}
