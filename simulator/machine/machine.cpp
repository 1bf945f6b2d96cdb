#include "simulator/machine/machine.hpp"

#include <algorithm>

#include "simulator/machine/faults.hpp"

namespace machine {

void LinkDirection::transfer(std::uint64_t bytes, Engine::Callback arrived) {
  if (std::exchange(busy_, true)) throw InvariantBroken("two messages at once on link " + name());
  since_ = engine_.now();
  bytes_ = bytes;
  use_.bytes_sent += bytes;
  arrived_ = std::move(arrived);
  engine_.transfer(from_.id(), to_.id(), bytes, [this] {
    use_.busy += engine_.now() - since_;
    ++use_.messages;
    use_.bytes += bytes_;
    busy_ = false;
    arrived_();
  });
}

LinkUse LinkDirection::use() const {
  LinkUse use = use_;
  if (busy_) use.busy += engine_.now() - since_;
  return use;
}

Processor& Machine::add_processor(std::string name, std::uint64_t memory) {
  const int id = engine_.add_processor(name);
  processors_.push_back(std::make_unique<Processor>(engine_, model_, id, std::move(name), memory));
  return *processors_.back();
}

void Machine::connect(Processor& a, Processor& b) {
  for (const Processor* p : {&a, &b}) {
    const auto used =
        std::ranges::count_if(links_, [&](const auto& link) { return &link->from() == p; });
    if (used >= 4) throw InvariantBroken(p->name() + " would have more than four links");
  }
  engine_.add_link(a.id(), b.id(), {model_.link.one_way_rate, model_.link.both_ways_rate});
  links_.push_back(std::make_unique<LinkDirection>(engine_, a, b));
  links_.push_back(std::make_unique<LinkDirection>(engine_, b, a));
}

LinkDirection& Machine::link(const Processor& from, const Processor& to) {
  for (auto& link : links_)
    if (&link->from() == &from && &link->to() == &to) return *link;
  throw InvariantBroken("no link joins " + from.name() + " and " + to.name());
}

void Machine::run() {
  events_ = engine_.run();
  for (const auto& processor : processors_)
    if (processor->failure()) std::rethrow_exception(processor->failure());
  for (const auto& link : links_)
    check_equal("bytes out of a link", link->use().bytes, link->use().bytes_sent);
  std::string waiting;
  for (const auto& processor : processors_) {
    for (const auto& process : processor->processes())
      if (process->state() != Process::State::ended)
        waiting += fmt::format("\n  {} waits for {}", process->name(), process->waiting_for());
  }
  if (!waiting.empty())
    throw Deadlock(
        "machine", now(),
        fmt::format("deadlock at {:.6f} s, nothing can happen any more:{}", now().value, waiting));
}

}  // namespace machine
