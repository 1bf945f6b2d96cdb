#include "simulator/machine/machine.hpp"

#include <set>

namespace machine {

namespace {

constexpr std::size_t MAX_LINKS = 4, WORD_BYTES = 4;

// Rates of a link that leads through C004 link switches. Each byte waits until the previous one has
// been acknowledged. Byte and acknowledgement both pass every switch, so each switch lengthens the
// time per byte.
LinkRates rates_through(const Model::Link& link, int switches) {
  const double period = link.bit_rate / link.one_way_rate + switches * link.switch_byte_bits;
  const double rate = link.bit_rate / period;
  return {std::min(link.one_way_rate, rate), std::min(link.both_ways_rate, 2 * rate)};
}

// Rates between processors of two models. Each end sends and acknowledges in turn, so the slower
// end determines the rates.
LinkRates rates_between(const Processor& a, const Processor& b, int switches) {
  const auto &one = a.model().link, &other = b.model().link;
  if (one.bit_rate != other.bit_rate)
    throw Misuse(a.name(), {},
                 fmt::format("the links of {} ({}) run at {} bit/s, those of {} ({}) at {}: "
                             "expected one speed at both ends",
                             a.name(), a.model().name, one.bit_rate, b.name(), b.model().name,
                             other.bit_rate));
  const auto here = rates_through(one, switches), there = rates_through(other, switches);
  return {std::min(here.one_way, there.one_way), std::min(here.both_ways, there.both_ways)};
}

// Fractions of a CPU's cycles that the DMA of a link takes: with one direction busy, with both
// busy.
std::array<double, 2> steal(const Model& model, const LinkRates& rates) {
  const double cycles = model.memory.steal_word / WORD_BYTES / model.cpu.clock.value;
  return {cycles * rates.one_way, cycles * std::min(rates.both_ways, 2 * rates.one_way)};
}

// The processes that have not ended, on processors that have not been stopped, by id.
using Blocked = std::map<ProcessId, const Process*>;
// For each blocked process: the processes of which any one could end its wait.
using Waits = std::map<ProcessId, std::vector<ProcessId>>;

bool waits_for_input(const Process& process) {
  if (process.state() != Process::State::blocked || !process.wait()) return false;
  const auto kind = process.waits_for();
  return kind == Wait::Kind::input || kind == Wait::Kind::alternative;
}

bool has_ended(const Process& process) {
  return process.state() == Process::State::ended ||
         (process.is_server() && waits_for_input(process));
}

Blocked find_blocked(const Machine& machine) {
  Blocked blocked;
  for (const auto& processor : machine.processors())
    for (const auto& process : processor->processes())
      if (!processor->stopped() && !has_ended(*process)) blocked[process->id()] = process.get();
  return blocked;
}

// Follows the waits from `process`, depth first. If it finds a cycle, returns true and leaves the
// cycle in `path`, with the first process repeated at the end.
bool find_cycle(ProcessId process, const Waits& waits, std::set<ProcessId>& seen,
                std::vector<ProcessId>& path) {
  const auto on_path = std::ranges::find(path, process);
  if (on_path != path.end()) {
    path.erase(path.begin(), on_path);
    path.push_back(process);
    return true;
  }
  if (!seen.insert(process).second) return false;
  path.push_back(process);
  for (ProcessId next : waits.at(process))
    if (waits.contains(next) && find_cycle(next, waits, seen, path)) return true;
  path.pop_back();
  return false;
}

std::string describe_wait(const Process& process, const std::vector<ProcessId>& partners,
                          const Blocked& blocked) {
  std::string text =
      fmt::format("\n  {} on {} waits for {}", process.name(), process.processor().name(),
                  process.wait() ? process.wait()->describe() : "its start");
  std::string names;
  for (ProcessId partner : partners)
    names += fmt::format(
        "{}{}", names.empty() ? "" : ", ",
        blocked.contains(partner) ? blocked.at(partner)->name() : "a process that has ended");
  return names.empty() ? text : fmt::format("{} (from {})", text, names);
}

std::vector<ProcessId> find_cycle(const Waits& waits) {
  std::set<ProcessId> seen;
  for (const auto& [process, ignored] : waits) {
    std::vector<ProcessId> path;
    if (find_cycle(process, waits, seen, path)) return path;
  }
  return {};
}

Waits find_waits(const Blocked& blocked) {
  Waits waits;
  for (const auto& [id, process] : blocked)
    waits[id] = process->wait() ? process->wait()->waits_for() : std::vector<ProcessId>{};
  return waits;
}

std::string describe_cycle(const Waits& waits, const Blocked& blocked) {
  std::string text;
  for (ProcessId p : find_cycle(waits))
    text += (text.empty() ? " " : " -> ") + blocked.at(p)->name();
  return text.empty() ? "" : "\n  the cycle:" + text;
}

// True if the processor has a process that has not ended. A server that waits for input counts as
// ended.
bool has_unfinished(const Processor& processor) {
  return !std::ranges::all_of(processor.processes(), [](const auto& p) { return has_ended(*p); });
}

// True if every processor is stopped or has no unfinished process.
bool all_have_ended(const Machine& machine) {
  return std::ranges::all_of(machine.processors(),
                             [](const auto& p) { return p->stopped() || !has_unfinished(*p); });
}

// Throws Deadlock if any process is unfinished. The message first names a cycle of waits, if there
// is one, then for each unfinished process its processor, its wait and the processes that could end
// it.
void throw_if_deadlocked(const Machine& machine) {
  const Blocked blocked = find_blocked(machine);
  if (blocked.empty()) return;
  const Waits waits = find_waits(blocked);
  std::string text = fmt::format("deadlock at {:.6f} s, nothing can happen any more:{}",
                                 machine.now().value, describe_cycle(waits, blocked));
  for (const auto& processor : machine.processors())
    for (const auto& process : processor->processes())
      if (blocked.contains(process->id()))
        text += describe_wait(*process, waits.at(process->id()), blocked);
  throw Deadlock("machine", machine.now(), text);
}

}  // namespace

std::vector<const Process*> find_wait_cycle(const Machine& machine) {
  Blocked blocked = find_blocked(machine);
  std::erase_if(blocked, [](const auto& of) {
    // After an interrupted run, a process that has not ended may be ready instead of blocked.
    return of.second->state() != Process::State::blocked;
  });
  std::vector<const Process*> cycle;
  for (ProcessId p : find_cycle(find_waits(blocked))) cycle.push_back(blocked.at(p));
  return cycle;
}

std::string_view to_string(End end) {
  constexpr std::string_view names[] = {"done", "limit", "interrupt", "deadlock"};
  return names[static_cast<int>(end)];
}

Processor& Machine::add_processor(std::string name, std::uint64_t memory, std::string role,
                                  std::shared_ptr<const Model> model) {
  auto shared = std::make_shared<Memory>(name, memory);
  Engine& engine = parts_.add_processor(name);
  return add(std::move(name), std::move(shared), std::move(role), model ? std::move(model) : model_,
             engine);
}

Processor& Machine::add_companion(Processor& of, std::string name, std::string role) {
  if (of.companion())
    throw Misuse(of.name(), now(),
                 fmt::format("{} already has a companion, {}: expected at most one", of.name(),
                             of.companion()->name()));
  Engine& engine = parts_.add_processor(name, &of.engine());
  Processor& companion =
      add(std::move(name), of.share_memory(), std::move(role), of.share_model(), engine);
  companion.join(of);
  of.join(companion);
  return companion;
}

Processor& Machine::add(std::string name, std::shared_ptr<Memory> memory, std::string role,
                        std::shared_ptr<const Model> model, Engine& engine) {
  const int id = static_cast<int>(processors_.size());
  processors_.push_back(std::make_unique<Processor>(engine, std::move(model), id, std::move(name),
                                                    std::move(memory), std::move(role), code_));
  ports_.push_back(0);
  return *processors_.back();
}

void Machine::connect(Processor& a, Processor& b, int switches) {
  if (&a == &b) throw Misuse(a.name(), now(), a.name() + " would have a link to itself");
  for (const Processor* p : {&a, &b})
    if (ports_.at(p->id()) >= MAX_LINKS)
      throw Misuse(p->name(), now(), p->name() + " would have more than four links");
  const auto rates = rates_between(a, b, switches);
  const auto end = [&](Processor& processor) {
    return Cable::End{&processor, ports_[processor.id()]++, steal(processor.model(), rates)};
  };
  const auto cable = std::make_shared<Cable>(end(a), end(b));
  const double bits = std::max(a.model().link.switch_bits, b.model().link.switch_bits);
  const Seconds delay{switches * bits / a.model().link.bit_rate};
  Engine& engine = parts_.between(a.engine(), b.engine());
  std::size_t direction = engine.add_link(a.id(), b.id(), rates, links_.size() / 2);
  for (auto [from, to] : {std::pair(&a, &b), std::pair(&b, &a)}) {
    auto& known = links_of_[{from->id(), to->id()}];
    links_.push_back(std::make_unique<LinkDirection>(engine, direction++, links_.size(), *from, *to,
                                                     known.size(), cable, delay));
    known.push_back(links_.back().get());
  }
}

LinkDirection& Machine::link(const Processor& from, const Processor& to, std::size_t number) {
  const auto found = links_of_.find({from.id(), to.id()});
  const auto count = found == links_of_.end() ? 0 : found->second.size();
  if (number < count) return *found->second[number];
  throw Misuse(from.name(), now(),
               count == 0
                   ? fmt::format("no link joins {} and {}", from.name(), to.name())
                   : fmt::format("found no link {} between {} and {}, expected numbers below {}",
                                 number, from.name(), to.name(), count));
}

void Machine::set_observer(Observer* observer) {
  if (observer) parts_.only("an observer");
  for (auto& processor : processors_) processor->set_observer(observer);
  for (auto& link : links_) link->set_observer(observer);
}

// The lookahead: the minimum time that any process needs to reach a link.
Seconds Machine::lookahead() const {
  Seconds least{std::numeric_limits<double>::infinity()};
  for (const auto& processor : processors_) {
    const auto cycles = static_cast<double>(processor->model().channel.least_to_link().value);
    least = std::min(least,
                     round_to_cycles(processor->software_factor() * cycles) / processor->clock());
  }
  return least;
}

// Rethrows the exception that ended the run. If several parts failed, rethrows the earliest one.
void Machine::throw_failure() const {
  const Processor* first = nullptr;
  for (const auto& processor : processors_)
    if (processor->failure() && (!first || processor->failed_at() < first->failed_at()))
      first = processor.get();
  if (first) std::rethrow_exception(first->failure());
}

End Machine::run(Seconds until) {
  runs_until_ = until;
  for (const Failure& failure : planned_) expect(failure);
  const Engine::End why = parts_.run(until, lookahead());
  throw_failure();
  const bool cut = why != Engine::End::no_event_left && !all_have_ended(*this);
  // All processes had ended when the run stopped, so the events still in the queue would have had
  // no effect. Sets the clock back to the last event with an effect.
  if (!cut && why != Engine::End::no_event_left) parts_.rewind();
  for (const auto& processor : processors_) processor->cpu().flush_observer();
  for (const auto& link : links_) link->flush_observer();
  if (cut) return why == Engine::End::until ? End::limit : End::interrupt;
  for (const auto& link : links_)
    base::check_equal("bytes that left a link", link->use().bytes + link->use().bytes_cut,
                      link->use().bytes_sent);
  throw_if_deadlocked(*this);
  return End::done;
}

void Machine::cut_link(Processor& a, Processor& b, Seconds at) {
  link(a, b);  // throws if no link exists
  plan({at, &a, &b});
}

void Machine::stop_processor(Processor& processor, Seconds at) { plan({at, &processor, nullptr}); }

void Machine::on_failure(std::function<void(const Failure&)> observer) {
  failure_observers_.push_back(std::move(observer));
}

void Machine::plan(const Failure& failure) {
  if (!(failure.at >= now()))
    throw base::InvariantBroken(
        fmt::format("found a failure planned for {} s at {} s, expected a later time",
                    failure.at.value, now().value));
  if (runs_until_) return expect(failure);
  planned_.push_back(failure);
}

// Schedules a failure. All failures of one date happen together, before any process can react.
void Machine::expect(const Failure& failure) {
  if (failure.at > *runs_until_) return;
  auto& together = failures_[failure.at];
  if (together.empty()) parts_.only("a failure").first_at(failure.at, [this] { happen_now(); });
  together.push_back(failure);
}

// Carries out the failures of the present date. If none of them has an effect, they do not extend
// the run.
void Machine::happen_now() {
  auto& together = failures_.at(now());
  bool matters = false;
  // Counts by index, because a callback of on_failure() may append failures.
  for (std::size_t i = 0; i < together.size(); ++i) {
    const Failure failure = together[i];
    matters |= happen(failure);
  }
  failures_.erase(now());
  if (!matters) parts_.only("a failure").ignore_event();
}

// True if the run is over: all processes have ended, no message is moving, and no CPU is busy
// beyond the present date.
bool Machine::is_over() const {
  if (!all_have_ended(*this)) return false;
  for (const auto& link : links_)
    if (link->is_busy()) return false;
  for (const auto& processor : processors_)
    if (processor->cpu().is_ahead()) return false;
  return true;
}

bool Machine::cut_both_ways(LinkDirection& link) {
  parts_.only("a failure").cut(link.direction());
  const bool there = link.cut(), back = links_[link.number() ^ 1]->cut();
  return there || back;
}

bool Machine::cut_all(const Processor& a, const Processor& b) {
  bool matters = false;
  for (LinkDirection* link : links_of_.at({a.id(), b.id()})) matters |= cut_both_ways(*link);
  return matters;
}

// Carries out one failure. Returns true if the failure has an effect.
bool Machine::happen(const Failure& failure) {
  Processor& a = *failure.a;
  if (is_over() || (failure.b ? link(a, *failure.b).is_cut() : a.stopped())) return false;
  const Engine& engine = parts_.only("a failure");
  const auto asked = engine.asked();
  bool matters = false;
  std::vector<Processor*> ends;  // processors whose processes must be notified
  if (failure.b) {
    matters = cut_all(a, *failure.b);
    ends = {&a, failure.b};
  } else {
    matters = has_unfinished(a);
    a.cpu().stop();
    for (const auto& link : links_) {
      if (&link->from() != &a || link->is_cut()) continue;
      matters |= cut_both_ways(*link);
      ends.push_back(&link->to());
    }
  }
  for (const auto& observer : failure_observers_) observer(failure);
  for (const Processor* end : ends)
    for (const auto& process : end->processes()) process->tell_cut();
  return matters || engine.asked() != asked;
}

}  // namespace machine
