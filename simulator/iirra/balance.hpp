#pragma once
// Load balancing between task managers (thesis, 5.1.3.1 and 6.2; H. Kuchen and A. Wagener, 1991). A
// manager remembers each request that it cannot serve, and serves it once it has tasks to spare, so
// nobody asks twice.
#include <memory>

#include "simulator/iirra/messages.hpp"

namespace iirra {

enum class BalanceMethod : std::uint8_t {
  none,
  neighbours,   ///< passive: a worker without tasks asks its neighbours, one after another
  coordinator,  ///< passive: it asks the coordinator and all processors on the way (InPathTo)
  active,       ///< a worker with new tasks gives some to the neighbour with the lowest known load
  mixed,        ///< active and neighbours combined
  green,        ///< tasks come down a tree from the coordinator, by counted demands (Green, 1991)
  ring          ///< requests circulate in a ring of all workers (Badouel, 1990)
};

/// The other task managers as one of them sees them, by processor number.
struct Peers {
  int self = 0, coordinator = 0;
  std::vector<int> neighbours;  ///< workers at the shortest distance
  int next = 0;                 ///< in the ring of workers; self if alone
  int parent = 0;               ///< in the spanning tree from the coordinator
};

/// Interface of a worker to its load balancing.
class TaskGiver {
 public:
  /// Number of active tasks, excluding the one in work.
  virtual std::size_t load() const = 0;
  /// Sends some tasks to `to`. Returns how many; 0 if there are none to spare.
  virtual std::size_t give(int to) = 0;
  virtual void send_to(network::Address to, IirraMessage::Content content) = 0;
  /// Hands an offered message that this worker does not serve back to the router.
  virtual void pass_on(const network::Message& message) = 0;

 protected:
  ~TaskGiver() = default;
};

class Balance {
 public:
  Balance(TaskGiver& giver, Peers peers) : giver_(giver), peers_(std::move(peers)) {}
  virtual ~Balance() = default;
  Balance(const Balance&) = delete;

  /// Called when few tasks are left, or none.
  virtual void ask() {}
  /// Called when the number of tasks has increased.
  virtual void created() {}
  /// Called after each microtask: tasks bound to it can now be given away.
  virtual void worked() {}
  /// Called with a request from another worker, in `message`.
  virtual void requested(const network::Message& message, const TaskRequest& request) = 0;
  virtual void refused(int /*by*/, std::size_t /*load*/) {}
  virtual void received(int /*from*/, std::size_t /*load*/) {}

 protected:
  TaskGiver& giver_;
  const Peers peers_;
};

std::unique_ptr<Balance> make_balance(BalanceMethod method, TaskGiver& giver, Peers peers);

}  // namespace iirra
