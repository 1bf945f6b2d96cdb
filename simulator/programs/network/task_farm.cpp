// A farm of equal tasks. The first processor distributes the tasks, and all others work on them.
// Either the workers or the first processor limit the throughput.
#include "simulator/network/store_and_forward.hpp"
#include "simulator/programs/declare/support.hpp"

namespace programs {

namespace task_farm {

struct Params {
  std::uint64_t bytes = 100;
  std::int64_t tasks_per_worker = 20;
  Cycles task_cycles{10'000'000}, centre_cycles{1'000'000};
};

struct Measured {
  Seconds time;
  double throughput_per_s = 0, cpu_busy_centre = 0;
};

constexpr int AHEAD = 2;  // number of tasks that each worker has or that are on the way to it

struct Farm {
  network::StoreAndForward& network;
  const Params& params;
  std::int64_t tasks;

  void send(int from, int to, std::uint64_t length) const {
    out(network.into(from), network::Pointer{{from, to, length}});
  }

  // Process of the first processor: sends a worker the next task for each result that arrives. When
  // no task is left, sends a message of STOP_BYTES instead, which stops the worker.
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
    compute(params.centre_cycles);
    send(0, worker, sent++ < tasks ? params.bytes : STOP_BYTES);
  }
  void work(int id) const {
    for (int stops = 0; stops < AHEAD;) {
      if (network.delivered(id).in().to.length == STOP_BYTES) {
        ++stops;
        continue;
      }
      compute(params.task_cycles);
      send(id, 0, params.bytes);
    }
  }
  static constexpr std::uint64_t STOP_BYTES = 1;  // less than the length of any task
};

Outcome<Measured> run(const Setup& setup, const Params& params) {
  const int workers = setup.topology.processors - 1;
  Machine machine(setup, setup.topology.processors);
  network::StoreAndForward network(machine, setup.topology);
  const Farm farm{network, params, params.tasks_per_worker * workers};
  std::vector<Seconds> results;
  auto& centre = machine[0];
  centre.start("centre", Priority::low, [&] { farm.coordinate(workers, results); });
  for (int id = 1; id <= workers; ++id)
    machine[id].start("worker", Priority::low, [&, id] { farm.work(id); });
  run_machine(setup, machine);
  // Measures the middle of the run, when all workers have tasks. Results come in bursts, so only
  // whole rounds are counted (one result from each worker).
  const auto round = static_cast<std::size_t>(workers);
  const std::size_t rounds = results.size() / round, a = rounds / 4 * round,
                    b = a + rounds / 2 * round;
  const double throughput = static_cast<double>(b - a) / (results[b] - results[a]).value;
  return Measured{machine.now(), throughput, centre.use().busy() / machine.now()};
}

}  // namespace task_farm

Program make_task_farm() {
  using namespace task_farm;
  using D = base::Declare<Params>;
  return make_program<Params, Measured>(
      {.name = "task_farm",
       .help = "a farm of equal tasks with its centre on the first processor",
       .uses = {.network = true, .others = true, .threads = true},
       .fields = {D::whole("bytes", &Params::bytes, 2, 1e9, "bytes",
                           "length of a task, and of its result"),
                  D::whole("tasks_per_worker", &Params::tasks_per_worker, 8, 1e6, "",
                           "tasks per worker"),
                  D::whole("task_cycles", &Params::task_cycles, 0, 1e10, "cycles",
                           "computation of a task by a worker"),
                  D::whole("centre_cycles", &Params::centre_cycles, 0, 1e10, "cycles",
                           "computation of the centre for each task")},
       .columns = {column("time_s", &Measured::time, "time until all workers have stopped"),
                   column("throughput_per_s", &Measured::throughput_per_s,
                          "results per second, in the middle of the run"),
                   column("cpu_busy_centre", &Measured::cpu_busy_centre,
                          "share of the time that the centre's CPU worked")},
       .run = &run});
}

}  // namespace programs
