// Links that are cut and processors that stop.
#include <utility>

#include "base/errors.hpp"
#include "simulator/machine/deadlock.hpp"
#include "simulator/machine/machine.hpp"

namespace machine {

void Machine::cut_link(Processor& a, Processor& b, Seconds at) {
  link(a, b);  // which there must be
  plan({at, &a, &b});
}

void Machine::stop_processor(Processor& processor, Seconds at) { plan({at, &processor, nullptr}); }

void Machine::on_failure(std::function<void(const Failure&)> observer) {
  failure_observers_.push_back(std::move(observer));
}

void Machine::plan(const Failure& failure) {
  if (!(failure.at >= now()))
    throw base::InvariantBroken(
        fmt::format("a failure at {} s was asked for at {} s", failure.at.value, now().value));
  if (runs_until_) return expect(failure);
  planned_.push_back(failure);
}

// Those of one date happen together, before any process can react.
void Machine::expect(const Failure& failure) {
  if (failure.at > *runs_until_) return;
  auto& together = failures_[failure.at];
  if (together.empty()) engine_.first_at(failure.at, [this] { happen_now(); });
  together.push_back(failure);
}

// It is an event of use only if it changes what happens: else it does not put off the end.
void Machine::happen_now() {
  auto& together = failures_.at(now());
  bool matters = false;
  for (std::size_t i = 0; i < together.size(); ++i) {  // an observer may add to them
    const Failure failure = together[i];
    matters |= happen(failure);
  }
  failures_.erase(now());
  if (!matters) engine_.ignore_event();
}

// Everything has ended, no message is under way, and no process is ahead of the clock.
bool Machine::is_over() const {
  if (!all_have_ended(*this)) return false;
  for (const auto& link : links_)
    if (link->is_busy()) return false;
  for (const auto& processor : processors_)
    if (processor->is_ahead()) return false;
  return true;
}

bool Machine::cut_both_ways(LinkDirection& link) {
  engine_.cut(link.from().id(), link.to().id());
  const bool there = link.cut(), back = this->link(link.to(), link.from()).cut();
  return there || back;
}

// Returns whether it changes what happens.
bool Machine::happen(const Failure& failure) {
  Processor& a = *failure.a;
  if (is_over() || (failure.b ? link(a, *failure.b).is_cut() : a.stopped())) return false;
  const auto asked = engine_.asked();
  bool matters = false;
  std::vector<Processor*> ends;  // that hear of it
  if (failure.b) {
    matters = cut_both_ways(link(a, *failure.b));
    ends = {&a, failure.b};
  } else {
    matters = has_unfinished(a);
    a.stop();
    for (const auto& link : links_) {
      if (&link->from() != &a || link->is_cut()) continue;
      matters |= cut_both_ways(*link);
      ends.push_back(&link->to());
    }
  }
  for (const auto& observer : failure_observers_) observer(failure);
  for (const Processor* end : ends)
    for (const auto& process : end->processes()) process->tell_cut();
  return matters || engine_.asked() != asked;
}

}  // namespace machine
