#pragma once
// Load balancing between the task managers of workers (thesis, 5.1.3.1 and 6.2; H. Kuchen and A.
// Wagener, 1991). A task manager stores each request for tasks that it cannot serve, and serves it
// as soon as it has tasks to spare. Workers therefore need not repeat requests.
#include <memory>

#include "simulator/iirra/tasks/messages.hpp"

namespace iirra {

enum class BalanceMethod : std::uint8_t {
  none,
  neighbours,   ///< a worker without tasks asks one neighbour after another
  coordinator,  ///< a worker without tasks asks all workers on its route to the coordinator
  active,       ///< a worker with new tasks gives some to the neighbour with the lowest known load
  mixed,        ///< combination of `active` and `neighbours`
  green,        ///< tasks move down a tree from the coordinator on request (Green, 1991)
  ring          ///< requests circulate in a ring of all workers (Badouel, 1990)
};

/// Processor numbers that a task manager needs for load balancing.
struct Peers {
  int self = 0, coordinator = 0;
  std::vector<int> neighbours;  ///< the workers closest to `self`
  int next = 0;                 ///< next worker in the ring of workers; `self` if there is only one
  int parent = 0;               ///< parent in the spanning tree from the coordinator
};

/// The functions of a worker that the worker's load balancing method calls.
class TaskGiver {
 public:
  /// Number of waiting tasks that are within the present limits. Does not count the task in
  /// progress.
  virtual std::size_t load() const = 0;
  /// Sends some tasks to worker `to`. Returns the number of tasks sent, 0 if there are none to
  /// spare.
  virtual std::size_t give(int to) = 0;
  virtual void send_to(network::Address to, IirraMessage content) = 0;
  /// Returns a message to the router, which forwards it, because this worker cannot serve the
  /// request.
  virtual void pass_on(const network::Message& message) = 0;

 protected:
  ~TaskGiver() = default;
};

class Balance {
 public:
  Balance(TaskGiver& giver, Peers peers) : giver_(giver), peers_(std::move(peers)) {}
  virtual ~Balance() = default;
  Balance(const Balance&) = delete;

  /// Called when few or no tasks are left.
  virtual void ask() {}
  /// Called when the number of tasks has increased.
  virtual void created() {}
  /// Called after each step of a task. During a step, tasks that use the sample in progress cannot
  /// be given away. After the step they can.
  virtual void worked() {}
  /// Called when `message`, which contains `request`, has arrived.
  virtual void requested(const network::Message& message, const TaskRequest& request) = 0;
  virtual void refused(int /*by*/, std::size_t /*load*/) {}
  virtual void received(int /*from*/, std::size_t /*load*/) {}

 protected:
  TaskGiver& giver_;
  const Peers peers_;
};

std::unique_ptr<Balance> make_balance(BalanceMethod method, TaskGiver& giver, Peers peers);

}  // namespace iirra
