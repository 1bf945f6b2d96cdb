#include "simulator/machine/parts.hpp"

#include <algorithm>
#include <cmath>

#include "simulator/machine/crew.hpp"
#include "simulator/machine/processor.hpp"

namespace machine {

namespace {

// Lower bound on `date + duration`. Both numbers may contain several rounding errors, all much
// smaller than the fractions subtracted here.
double at_the_earliest(double date, double duration) {
  return date + (1 - 1e-9) * duration - 1e-14 * date;
}

Moment just_after(Moment moment) {
  ++moment.rank;
  return moment;
}

// Finds the parts with events before the end of a window. `next` has the next event of each part,
// and `first` is the earliest of these. Returns the end of the window, which is shrunk to the event
// `first` if the window has no event.
Moment choose_busy(const std::vector<Moment>& next, Moment first, Moment end,
                   std::vector<std::size_t>& busy) {
  busy.clear();
  for (std::size_t part = 0; part < next.size(); ++part)
    if (next[part] < end) busy.push_back(part);
  if (!busy.empty()) return end;
  busy.push_back(std::ranges::find(next, first) - next.begin());
  return just_after(first);
}

}  // namespace

Parts::Parts(EngineParams params) : part_of_(std::exchange(params.parts, {})) {
  const int parts = part_of_.empty() ? 1 : *std::ranges::max_element(part_of_) + 1;
  if (parts > 1 && params.links != Links::direct)
    throw base::InvariantBroken(fmt::format("found {} parts with SimGrid, expected one", parts));
  if (!part_of_.empty() && std::ranges::min(part_of_) < 0)
    throw base::InvariantBroken(
        fmt::format("found part {}, expected 0 or more", std::ranges::min(part_of_)));
  const MakeCarrier make = params.links == Links::direct ? &make_direct : &make_simgrid;
  for (int part = 0; part < parts; ++part)
    engines_.push_back(std::make_unique<Engine>(make, params.processes));
  if (!is_one()) between_ = std::make_unique<Engine>(make, params.processes);
}

Engine& Parts::add_processor(const std::string& name, const Engine* beside) {
  const auto id = static_cast<std::size_t>(processors_++);
  const auto is_beside = [&](const auto& engine) { return engine.get() == beside; };
  const auto same = std::ranges::find_if(engines_, is_beside);
  const std::size_t part = same != engines_.end() ? same - engines_.begin()
                           : id < part_of_.size() ? part_of_[id]
                                                  : 0;
  engines_[part]->add_processor(name);
  return *engines_[part];
}

Engine& Parts::only(const char* asked) {
  if (is_one()) return *engines_.front();
  throw base::InvariantBroken(fmt::format(
      "found {} called for a machine in {} parts, expected one part", asked, engines_.size()));
}

Engine::End Parts::run(Seconds until, Seconds lookahead) {
  return is_one() ? engines_.front()->run(until) : run_windows(until, lookahead);
}

Engine::End Parts::run_windows(Seconds until, Seconds lookahead) {
  if (!(lookahead.value > 0))
    throw base::InvariantBroken(
        "found operations on links that cost nothing in a machine of several parts, expected one "
        "part");
  for (const auto& engine : engines_) engine->events().set_until(until.value);
  between_->events().set_until(until.value);
  engines_.front()->at({}, [] {});  // starts callbacks scheduled before the run, as in Engine::run
  Crew crew(engines_.size(), [&](std::size_t part) { engines_[part]->run_before(bound_); });
  std::vector<Moment> next(engines_.size());  // the next event of each part
  std::vector<std::size_t> busy;              // the parts with events in the window
  for (;;) {
    if (const Events* events = stopped()) {
      be_at(latest());
      return events->end();
    }
    for (std::size_t part = 0; part < next.size(); ++part) next[part] = engines_[part]->next();
    const Moment first = std::ranges::min(next), at_links = between_->next();
    const double date = std::min(first, at_links).date;
    if (date == Events::NEVER) break;
    be_at(std::min(date, until.value));
    if (date > until.value) return Engine::End::until;
    if (at_links < first) {
      ++windows_.at_links;
      between_->run_before(just_after(at_links));
      continue;
    }
    bound_ = std::min(end_of_window(first.date, lookahead.value), at_links);
    bound_ = choose_busy(next, first, bound_, busy);
    ++windows_.all;
    if (busy.size() > 1) ++windows_.shared;
    crew.work(busy);
  }
  rewind();
  return Engine::End::no_event_left;
}

double Parts::latest() const {
  double date = between_->now().value;
  for (const auto& engine : engines_) date = std::max(date, engine->now().value);
  return date;
}

void Parts::be_at(double date) {
  for (const auto& engine : engines_) engine->events().advance(date);
  between_->events().advance(date);
}

// End of the window that starts at `date`. Before this end, no process can reach a link between
// parts. An announced process reaches a link only when its computation ends; any other process
// needs at least the lookahead.
Moment Parts::end_of_window(double date, double lookahead) const {
  double end = at_the_earliest(date, lookahead);
  for (const auto& engine : engines_)
    for (const Process* process : engine->coming())
      end = std::min(end,
                     at_the_earliest(date, process->processor().cpu().least_left(*process).value));
  return {std::min(end, std::nextafter(engines_.front()->until().value, Events::NEVER))};
}

const Events* Parts::stopped() const {
  for (const auto& engine : engines_)
    if (engine->events().stopped()) return &engine->events();
  return between_->events().stopped() ? &between_->events() : nullptr;
}

void Parts::rewind() {
  if (is_one()) return engines_.front()->rewind();
  double last = between_->events().last_useful();
  for (const auto& engine : engines_) last = std::max(last, engine->events().last_useful());
  for (const auto& engine : engines_) engine->events().rewind_to(last);
  between_->events().rewind_to(last);
}

void Parts::stop() {
  for (const auto& engine : engines_) engine->stop();
}

std::uint64_t Parts::handled() const {
  std::uint64_t sum = is_one() ? 0 : between_->handled();
  for (const auto& engine : engines_) sum += engine->handled();
  return sum;
}

}  // namespace machine
