#include "simulator/iirra/tasks/balance.hpp"

#include <algorithm>
#include <map>

namespace iirra {

using network::Address;
using network::Message;
using network::Mode;

namespace {

class NoBalance : public Balance {
 public:
  using Balance::Balance;
  void requested(const Message& /*message*/, const TaskRequest& /*request*/) override {
    throw base::InvariantBroken("a request for tasks, although tasks are not shared");
  }
};

// Base class of methods that let workers without tasks make requests. A worker sends one request,
// then waits for tasks or new limits. A worker without tasks to spare may store a request until it
// has tasks to spare.
class Passive : public Balance {
 public:
  using Balance::Balance;

  void ask() override {
    if (std::exchange(is_asking_, true)) return;
    begin();
  }
  void created() override { serve(); }
  void worked() override { serve(); }
  void received(int /*from*/, std::size_t /*load*/) override {
    is_asking_ = false;
    serve();
  }

 protected:
  virtual void begin() = 0;
  void serve() {
    while (!wanting_.empty() && giver_.give(wanting_.front()) > 0) wanting_.erase(wanting_.begin());
  }
  void remember(int asker) {
    if (std::ranges::find(wanting_, asker) == wanting_.end()) wanting_.push_back(asker);
  }
  bool is_asking_ = false;

 private:
  std::vector<int> wanting_;  // workers with unserved requests, by time of arrival
};

class AskNeighbours : public Passive {
 public:
  using Passive::Passive;

  void requested(const Message& message, const TaskRequest& request) override {
    if (giver_.give(request.asker) > 0) return;
    remember(request.asker);
    giver_.send_to({message.from.processor, TASK_PROCESS}, NoTasks{giver_.load()});
  }
  void refused(int /*by*/, std::size_t /*load*/) override {
    if (is_asking_ && ++refusals_ < peers_.neighbours.size()) ask_next();
  }

 private:
  void begin() override {
    refusals_ = 0;
    if (!peers_.neighbours.empty()) ask_next();
  }
  void ask_next() {
    const int to = peers_.neighbours[next_++ % peers_.neighbours.size()];
    giver_.send_to({to, TASK_PROCESS}, TaskRequest{peers_.self});
  }
  std::size_t refusals_ = 0, next_ = 0;
};

// A request travels to the coordinator, and every worker on the route may serve it. If no worker
// has served it, the coordinator forwards the request to the next worker in rotation. This worker
// stores the request.
class AskCoordinator : public Passive {
 public:
  using Passive::Passive;
  void requested(const Message& message, const TaskRequest& request) override {
    if (giver_.give(request.asker) > 0) return;
    if (request.is_last)
      remember(request.asker);
    else
      giver_.pass_on(message);
  }

 private:
  void begin() override {
    giver_.send_to({peers_.coordinator, TASK_PROCESS, Mode::in_path_to}, TaskRequest{peers_.self});
  }
};

// Requests travel around the ring of workers. A request that returns to its sender unserved is sent
// around once more. In this second round, a worker that cannot serve the request stores it.
class AskRing : public Passive {
 public:
  using Passive::Passive;
  void requested(const Message& /*message*/, const TaskRequest& request) override {
    if (request.asker == peers_.self) {
      if (giver_.load() == 0)
        pass({request.asker, true});
      else
        is_asking_ = false;
    } else if (giver_.give(request.asker) == 0) {
      if (request.is_last)
        remember(request.asker);
      else
        pass(request);
    }
  }

 private:
  void begin() override {
    if (peers_.next != peers_.self) pass({peers_.self});
  }
  void pass(const TaskRequest& request) { giver_.send_to({peers_.next, TASK_PROCESS}, request); }
};

// Gives tasks to neighbours with few tasks. The load of a neighbour is estimated as the load in its
// last message plus the number of tasks that were given to it since then.
class Distribution {
 public:
  Distribution(TaskGiver& giver, const Peers& peers) : giver_(giver) {
    for (const int neighbour : peers.neighbours) loads_[neighbour] = 0;
  }
  void note(int neighbour, std::size_t load) {
    if (const auto known = loads_.find(neighbour); known != loads_.end()) known->second = load;
  }
  void distribute() {
    if (loads_.empty()) return;
    const auto least = std::ranges::min_element(
        loads_, [](const auto& a, const auto& b) { return a.second < b.second; });
    if (giver_.load() > least->second + 1) least->second += giver_.give(least->first);
  }

 private:
  TaskGiver& giver_;
  std::map<int, std::size_t> loads_;
};

class Active : public Balance {
 public:
  Active(TaskGiver& giver, const Peers& peers)
      : Balance(giver, peers), distribution_(giver, peers) {}
  void created() override { distribution_.distribute(); }
  void requested(const Message& /*message*/, const TaskRequest& /*request*/) override {
    throw base::InvariantBroken("a request for tasks, although tasks are sent unasked");
  }
  void received(int from, std::size_t load) override { distribution_.note(from, load); }

 private:
  Distribution distribution_;
};

class Mixed : public AskNeighbours {
 public:
  Mixed(TaskGiver& giver, const Peers& peers)
      : AskNeighbours(giver, peers), distribution_(giver, peers) {}
  void created() override {
    AskNeighbours::created();
    distribution_.distribute();
  }
  void refused(int by, std::size_t load) override {
    distribution_.note(by, load);
    AskNeighbours::refused(by, load);
  }
  void received(int from, std::size_t load) override {
    distribution_.note(from, load);
    AskNeighbours::received(from, load);
  }

 private:
  Distribution distribution_;
};

// Each worker sends its parent one request at a time, for itself or on behalf of a child.
class Green : public Balance {
 public:
  using Balance::Balance;
  void ask() override {
    if (std::exchange(is_asking_, true)) return;
    giver_.send_to({peers_.parent, TASK_PROCESS}, TaskRequest{peers_.self});
  }
  void created() override { serve(); }
  void worked() override { serve(); }
  void requested(const Message& /*message*/, const TaskRequest& request) override {
    ++demands_[request.asker];
    serve();
    if (demands_[request.asker] > 0) ask();
  }
  void received(int /*from*/, std::size_t /*load*/) override {
    is_asking_ = false;
    serve();
    if (std::ranges::any_of(demands_, [](const auto& child) { return child.second > 0; })) ask();
  }

 private:
  void serve() {
    for (auto& [child, demand] : demands_)
      for (; demand > 0 && giver_.give(child) > 0; --demand) {
      }
  }
  bool is_asking_ = false;
  std::map<int, int> demands_;  // number of requested tasks not yet given, by child
};

}  // namespace

std::unique_ptr<Balance> make_balance(BalanceMethod method, TaskGiver& giver, Peers peers) {
  switch (method) {
    case BalanceMethod::neighbours:
      return std::make_unique<AskNeighbours>(giver, std::move(peers));
    case BalanceMethod::coordinator:
      return std::make_unique<AskCoordinator>(giver, std::move(peers));
    case BalanceMethod::active:
      return std::make_unique<Active>(giver, std::move(peers));
    case BalanceMethod::mixed:
      return std::make_unique<Mixed>(giver, std::move(peers));
    case BalanceMethod::green:
      return std::make_unique<Green>(giver, std::move(peers));
    case BalanceMethod::ring:
      return std::make_unique<AskRing>(giver, std::move(peers));
    case BalanceMethod::none:
      return std::make_unique<NoBalance>(giver, std::move(peers));
  }
  throw base::InvariantBroken("an unknown method of balancing");
}

}  // namespace iirra
