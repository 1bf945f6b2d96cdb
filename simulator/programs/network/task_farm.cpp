// A farm of equal tasks: the first processor hands them out, the others work. Its throughput is
// bound by the workers, or by the centre.
#include "simulator/declare/support.hpp"
#include "simulator/network/store_and_forward.hpp"

namespace programs {

namespace {

constexpr int AHEAD = 2;  // tasks a worker has, or that are on their way to it

struct Farm {
  network::StoreAndForward& network;
  std::uint64_t bytes;
  std::int64_t tasks;
  Cycles centre, task;

  void send(int from, int to, std::uint64_t length) const {
    network::Pointer packet;
    packet.to = {from, to, length, 0, {}};
    out(network.into(from), packet);
  }

  // Each result is answered with the next task; an empty one tells a worker to stop.
  void coordinate(int workers, std::vector<Seconds>& results) const {
    std::int64_t sent = 0;
    for (int turn = 0; turn < AHEAD; ++turn)
      for (int id = 1; id <= workers; ++id) hand_out(id, sent);
    for (int stopped = 0; stopped < AHEAD * workers;) {
      const network::Pointer result = network.delivered(0).in();
      results.push_back(now());
      if (sent >= tasks) ++stopped;
      hand_out(result.to.from, sent);
    }
  }
  void hand_out(int worker, std::int64_t& sent) const {
    compute(centre);
    send(0, worker, sent++ < tasks ? bytes : STOP_BYTES);
  }
  void work(int id) const {
    for (int stops = 0; stops < AHEAD;) {
      if (network.delivered(id).in().to.length == STOP_BYTES) {
        ++stops;
        continue;
      }
      compute(task);
      send(id, 0, bytes);
    }
  }
  static constexpr std::uint64_t STOP_BYTES = 1;  // shorter than any task
};

Row run(const Setup& setup) {
  const int workers = setup.topology.processors - 1;
  machine::Machine machine(setup.model);
  add_processors(machine, setup.topology.processors);
  network::StoreAndForward network(machine, setup.topology);
  const Farm farm{network, static_cast<std::uint64_t>(setup.whole("bytes")),
                  setup.whole("tasks_per_worker") * workers, Cycles{setup.whole("centre_cycles")},
                  Cycles{setup.whole("task_cycles")}};
  std::vector<Seconds> results;
  auto& centre = *machine.processors()[0];
  centre.start("centre", Priority::low, [&] { farm.coordinate(workers, results); });
  for (int id = 1; id <= workers; ++id)
    machine.processors()[id]->start("worker", Priority::low, [&, id] { farm.work(id); });
  run_machine(setup, machine);
  // In the middle, when every worker has tasks; in whole rounds, as results may come in bursts.
  const auto round = static_cast<std::size_t>(workers);
  const std::size_t rounds = results.size() / round, a = rounds / 4 * round,
                    b = a + rounds / 2 * round;
  const double throughput = static_cast<double>(b - a) / (results[b] - results[a]).value;
  return {{"time_s", machine.now().value},
          {"throughput_per_s", throughput},
          {"cpu_busy_centre", centre.use().busy() / machine.now()}};
}

}  // namespace

Pattern make_task_farm() {
  return {"task_farm",
          "a farm of equal tasks, its centre the first processor: throughput_per_s",
          true,
          {{"bytes", 100, 2, 1e9, true, "of a task, and of its result"},
           {"tasks_per_worker", 20, 8, 1e6, true, "in all, for each worker"},
           {"task_cycles", 1e7, 0, 1e10, true, "of a worker, for a task"},
           {"centre_cycles", 1e6, 0, 1e10, true, "of the centre, for a task"}},
          &run};
}

}  // namespace programs
