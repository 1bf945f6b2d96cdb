#pragma once
// How task managers share tasks while they work (thesis, 5.1.3.1 and 6.2; H. Kuchen and A. Wagener,
// 1991). A task that cannot be had is remembered by the one that was asked: it gives some as soon
// as it has any to spare, so that nobody asks twice.
#include <memory>

#include "simulator/iirra/messages.hpp"

namespace iirra {

enum class BalanceMethod : std::uint8_t {
  none,
  neighbours,   ///< passive: who has no task asks its neighbours, one after the other
  coordinator,  ///< passive: it asks the coordinator, and all on the way (InPathTo)
  active,       ///< who has made tasks gives some to the neighbour that seems to have least
  mixed,        ///< active and neighbours
  green,        ///< tasks come down a tree from the coordinator, by counted demands (Green, 1991)
  ring          ///< requests go round a ring of all workers (Badouel, 1990)
};

/// The other task managers, by their processors, as one of them sees them.
struct Peers {
  int self = 0, coordinator = 0;
  std::vector<int> neighbours;  ///< the workers that are nearest
  int next = 0;                 ///< in the ring of workers; itself if it is alone
  int parent = 0;               ///< in the spanning tree from the coordinator
};

/// A worker, as its balancing sees it.
class TaskGiver {
 public:
  /// Active tasks, without the one in hand.
  virtual std::size_t load() const = 0;
  /// Sends some of its tasks, and returns how many: 0 if it has none to spare.
  virtual std::size_t give(int to) = 0;
  virtual void send_to(network::Address to, IirraMessage::Content content) = 0;
  /// To its router: an offered message that it does not take.
  virtual void pass_on(const network::Message& message) = 0;

 protected:
  ~TaskGiver() = default;
};

class Balance {
 public:
  Balance(TaskGiver& giver, Peers peers) : giver_(giver), peers_(std::move(peers)) {}
  virtual ~Balance() = default;
  Balance(const Balance&) = delete;

  /// Few tasks are left, or none.
  virtual void ask() {}
  /// There are more tasks than before.
  virtual void created() {}
  /// A microtask has ended: tasks that could not go then may go now.
  virtual void worked() {}
  /// By another worker, which `message` is of.
  virtual void requested(const network::Message& message, const TaskRequest& request) = 0;
  virtual void refused(int /*by*/, std::size_t /*load*/) {}
  virtual void received(int /*from*/, std::size_t /*load*/) {}

 protected:
  TaskGiver& giver_;
  const Peers peers_;
};

std::unique_ptr<Balance> make_balance(BalanceMethod method, TaskGiver& giver, Peers peers);

}  // namespace iirra
