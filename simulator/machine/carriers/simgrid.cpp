#include <xbt/base.h>  // must precede version.h, which depends on it

#include <fmt/format.h>
#include <simgrid/version.h>
#include <simgrid/kernel/Timer.hpp>
#include <simgrid/s4u.hpp>
#if __has_include(<simgrid/simcall.hpp>)
#include <simgrid/simcall.hpp>
#else
#include <simgrid/simix.hpp>
#endif

#include <algorithm>
#include <csignal>
#include <deque>
#include <exception>
#include <utility>

#include "base/early_end.hpp"
#include "base/errors.hpp"
#include "simulator/machine/carriers/carrier.hpp"
#include "simulator/machine/carriers/forecast.hpp"

namespace machine {

namespace s4u = simgrid::s4u;
using simgrid::kernel::timer::Timer;

std::string simgrid_version() {
  int major = 0, minor = 0, patch = 0;
  sg_version_get(&major, &minor, &patch);
  return fmt::format("{}.{}.{}", major, minor, patch);
}

namespace {

// Wrappers of calls that have different names in SimGrid 3 and 4. They are templates, because in a
// template the compiler ignores a call that does not exist.
auto make_zone(auto& engine, const auto& name) {
  if constexpr (requires { engine.get_netzone_root()->add_netzone_full(name); })
    return engine.get_netzone_root()->add_netzone_full(name);
  else
    return s4u::create_full_zone(name);
}

s4u::Host* add_host(auto& zone, const std::string& name) {
  if constexpr (requires { zone.add_host(name, "1f"); })
    return zone.add_host(name, "1f")->seal();
  else
    return zone.create_host(name, "1f")->seal();
}

s4u::Link* add_link(auto& zone, const std::string& name, double rate) {
  if constexpr (requires { zone.add_link(name, rate); })
    return zone.add_link(name, rate);
  else
    return zone.create_link(name, rate);
}

void add_route(auto& zone, const s4u::Host* from, const s4u::Host* to, const s4u::Link* link) {
  const std::vector<s4u::LinkInRoute> links{s4u::LinkInRoute(link)};
  if constexpr (requires { zone.add_route(from, to, links); })
    zone.add_route(from, to, links);
  else
    zone.add_route(from->get_netpoint(), to->get_netpoint(), nullptr, nullptr, links, true);
}

void add_actor(auto& engine, const std::string& name, s4u::Host* host, auto body) {
  if constexpr (requires { engine.add_actor(name, host, body); })
    engine.add_actor(name, host, body);
  else
    s4u::Actor::create(name, host, body);
}

// Restores the program's signal handlers and terminate handler, which SimGrid replaces at start-up.
class KeptSignals {
 public:
  KeptSignals() {
    for (std::size_t i = 0; i < std::size(SIGNALS); ++i) sigaction(SIGNALS[i], nullptr, &kept_[i]);
  }
  ~KeptSignals() {
    for (std::size_t i = 0; i < std::size(SIGNALS); ++i) sigaction(SIGNALS[i], &kept_[i], nullptr);
    std::set_terminate(terminate_);
  }

 private:
  static constexpr int SIGNALS[] = {SIGINT, SIGTERM, SIGSEGV};
  // Blocks the signals in SIGNALS while this object exists, because SimGrid's handlers would end
  // the program.
  const base::HeldSignals held_{SIGNALS};
  struct sigaction kept_[std::size(SIGNALS)];
  std::terminate_handler terminate_ = std::get_terminate();
};

// Thrown by SimGrid's callback for deadlocks, so that SimGrid's run() ends when all actors wait.
// OnSimGrid::run() catches it.
struct AllWait {};

class ActorCoroutine;

// A SimGrid actor that executes one process body after another. Actors are reused, because branches
// of PARs are short-lived and SimGrid frees ended actors only when its clock advances.
struct Hand {
  s4u::SemaphorePtr own_turn = s4u::Semaphore::create(0), others_turn = s4u::Semaphore::create(0);
  ActorCoroutine* works_for = nullptr;
};
using Hands = std::vector<std::shared_ptr<Hand>>;

// A coroutine that runs on a SimGrid actor. SimGrid's scheduler (the maestro) resumes one actor at
// a time. The body and its caller take turns by means of two semaphores.
class ActorCoroutine final : public Coroutine {
 public:
  // `idle` holds the idle actors of this SimGrid host. A reused actor keeps the name of the first
  // body that it executed.
  ActorCoroutine(s4u::Engine& engine, s4u::Host* host, Hands& idle, std::string name, Body body)
      : engine_(engine), host_(host), idle_(idle), name_(std::move(name)), body_(std::move(body)) {}

  void resume() override {
    if (hand_) {
      hand_->own_turn->release();
    } else if (idle_.empty()) {
      hand_ = std::make_shared<Hand>();
      hand_->works_for = this;
      add_actor(engine_, name_, host_, [hand = hand_, &idle = idle_] { work(hand, idle); });
    } else {
      hand_ = std::move(idle_.back());
      idle_.pop_back();
      hand_->works_for = this;
      hand_->own_turn->release();
    }
    if (s4u::Actor::is_maestro())  // true after the run, when stacks are unwound
      engine_.run_until(s4u::Engine::get_clock());
    else
      hand_->others_turn->acquire();
  }

  void suspend() override {
    hand_->others_turn->release();
    hand_->own_turn->acquire();
  }

 private:
  static void work(const std::shared_ptr<Hand>& hand, Hands& idle) {
    while (auto* coroutine = std::exchange(hand->works_for, nullptr)) {
      std::exchange(coroutine->body_, {})();
      coroutine->has_ended_ = true;
      idle.push_back(hand);
      hand->others_turn->release();  // the coroutine may be destroyed from here on
      hand->own_turn->acquire();
    }
  }

  s4u::Engine& engine_;
  s4u::Host* host_;
  Hands& idle_;
  std::string name_;
  Body body_;
  std::shared_ptr<Hand> hand_;
};

// A carrier that uses SimGrid. Events come from two sources: tlab's own queue, and the ends of
// SimGrid's communications. A round of SimGrid's loop costs more than most events of the queue. The
// carrier therefore handles queued events ahead of SimGrid's clock as long as no communication can
// end before them (conservative lookahead). Then it sets a SimGrid timer for the next queued event,
// unless a communication will certainly end earlier. The forecast only serves these two decisions;
// SimGrid decides when a message ends.
class OnSimGrid final : public Carrier {
 public:
  OnSimGrid(Events& events, Processes processes);
  ~OnSimGrid() override {
    if (!called_) return;
    called_->release();
    for (const auto& hands : idle_)
      for (const auto& hand : hands) hand->own_turn->release();
    engine_->run_until(s4u::Engine::get_clock());
  }

  void add_processor(const std::string& name) override {
    hosts_.push_back(add_host(*zone_, name));
    idle_.emplace_back();
  }
  std::size_t add_link(int a, int b, LinkRates rates, std::size_t rank) override;
  std::unique_ptr<Coroutine> make_coroutine(int processor, const std::string& name,
                                            Coroutine::Body body) override {
    if (!has_actors_) return make_fiber(std::move(body));
    return std::make_unique<ActorCoroutine>(*engine_, hosts_.at(processor), idle_.at(processor),
                                            name, std::move(body));
  }
  void start(std::size_t number, std::uint64_t bytes, Callback arrived) override;
  double left_of(std::size_t number, double date) const override {
    return forecast_.left(number, date);
  }
  void cut(std::size_t number) override {
    directions_[number].cut = true;
    forecast_.end(number, events_.now());
    forecast_.settle();
  }
  void run() override;
  Moment next() override { throw_in_parts(); }
  void run_before(const Moment& /*bound*/) override { throw_in_parts(); }

 private:
  [[noreturn]] static void throw_in_parts() {
    throw base::InvariantBroken(
        "found SimGrid for a machine in several parts, expected the direct engine");
  }
  // One direction of a link. Its index in directions_ also identifies it in the forecast and in
  // SimGrid's communications.
  struct Direction {
    s4u::Host *from, *to;
    s4u::CommPtr comm = {};  // communication that carries the present message
    std::uint64_t bytes = 0;
    double since = 0;
    Callback arrived = {};
    bool cut = false;  // if true, SimGrid's later callbacks have no effect
  };

  template <class Call>
  void call(Call call) {
    if (!called_) return call();
    calls_.emplace_back(call);
    called_->release();
  }
  void start_scheduler();
  void run_ahead();
  void start_now(std::size_t number);
  void start_all(double date);
  void start_later(std::size_t number);
  void end(std::size_t number);
  void check_end(const Direction& direction, double date, const Forecast::End& expected) const;

  Events& events_;  // its clock may be ahead of SimGrid's clock
  std::unique_ptr<s4u::Engine> engine_;
  s4u::NetZone* zone_ = nullptr;
  std::vector<s4u::Host*> hosts_;              // by processor
  std::map<std::pair<int, int>, int> joined_;  // number of links so far, by pair of processors
  double wake_up_ = Events::NEVER;             // date in s for which a SimGrid timer is set
  std::vector<Direction> directions_;
  Forecast forecast_;
  // Communications that wait until SimGrid's clock reaches their date: the date in s and the
  // direction.
  std::deque<std::pair<double, std::size_t>> starts_;
  s4u::CommPtr last_ended_;

  // With actors, tlab's event loop runs in an actor too, because it must wait while other actors
  // run. This actor executes the callbacks of SimGrid.
  bool has_actors_;
  std::deque<Hands> idle_;    // by processor
  s4u::SemaphorePtr called_;  // released once for each call, and once more to end the scheduler
  std::deque<Callback> calls_;
  std::exception_ptr failure_;  // exception thrown by a call
};

OnSimGrid::OnSimGrid(Events& events, Processes processes)
    : events_(events), has_actors_(processes == Processes::actors) {
  static int argc = 3;
  static char name[] = "tlab", to[] = "--log=root.app:file:/dev/null",
              only[] = "--log=root.thres:critical";
  static char* argv[] = {name, to, only, nullptr};
  {
    const KeptSignals kept;
    engine_ = std::make_unique<s4u::Engine>(&argc, argv);
  }
  // Selects SimGrid's plain fluid model of links, without corrections for TCP or cross traffic, and
  // with a time resolution of one picosecond.
  for (const char* setting :
       {"network/model:CM02", "network/bandwidth-factor:1", "network/latency-factor:1",
        "network/crosstraffic:0", "network/TCP-gamma:0", "surf/precision:1e-12"})
    s4u::Engine::set_config(setting);
  zone_ = make_zone(*engine_, std::string("machine"));
  s4u::Comm::on_completion_cb([this](const auto& comm) {
    call([this, number = reinterpret_cast<std::size_t>(comm.template get_data<void>())] {
      end(number);
    });
  });
  if (!has_actors_) return;
  const auto stack = fmt::format("contexts/stack-size:{}", Coroutine::STACK_BYTES / 1024);
  for (const std::string& setting : {stack, std::string("contexts/guard-size:0")})
    s4u::Engine::set_config(setting);
  s4u::Engine::on_deadlock_cb([] { throw AllWait(); });
}

std::size_t OnSimGrid::add_link(int a, int b, LinkRates rates, std::size_t rank) {
  const auto rate = [rates](double, int messages) {
    return messages > 1 ? rates.both_ways : rates.one_way;
  };
  const auto name = fmt::format("{}-{}-{}", a, b, joined_[std::minmax(a, b)]++);
  auto* link = machine::add_link(*zone_, name, rates.both_ways)
                   ->set_sharing_policy(s4u::Link::SharingPolicy::NONLINEAR, rate)
                   ->seal();
  // SimGrid allows one route between two hosts. Each further link between the same processors
  // therefore starts at an additional host.
  const bool is_first = joined_[std::minmax(a, b)] == 1;
  auto *from = is_first ? hosts_[a] : add_host(*zone_, "port " + name), *to = hosts_[b];
  add_route(*zone_, from, to, link);
  directions_.push_back({from, to});
  directions_.push_back({to, from});
  return forecast_.add_link(rates.one_way, rates.both_ways, rank);
}

void OnSimGrid::start(std::size_t number, std::uint64_t bytes, Callback arrived) {
  Direction& direction = directions_[number];
  direction.bytes = bytes;
  direction.since = events_.now();
  direction.arrived = arrived;
  forecast_.start(number, static_cast<double>(bytes), events_.now());
  forecast_.settle();
  if (events_.now() > s4u::Engine::get_clock())
    start_later(number);
  else
    start_now(number);
}

void OnSimGrid::run() {
  {
    const KeptSignals kept;
    zone_->seal();
  }
  if (has_actors_ && !hosts_.empty()) start_scheduler();
  call([this] { run_ahead(); });
  try {
    engine_->run();
  } catch (const AllWait&) {  // all actors wait for ever, and SimGrid would end them with an error
  }
  if (failure_) std::rethrow_exception(failure_);
}

void OnSimGrid::start_scheduler() {
  called_ = s4u::Semaphore::create(0);
  add_actor(*engine_, "scheduler", hosts_.front(), [this] {
    for (called_->acquire(); !calls_.empty(); called_->acquire()) {
      Callback next = calls_.front();
      calls_.pop_front();
      try {
        next();
      } catch (...) {
        failure_ = std::current_exception();
        events_.stop(Events::End::no_event_left);
      }
    }
  });
}

// Handles queued events that come before the earliest possible end of a communication. Events up to
// SimGrid's clock are always safe: communications that end by then have already been reported.
void OnSimGrid::run_ahead() {
  const double clock = s4u::Engine::get_clock();
  while (!events_.stopped() && events_.next() < Events::NEVER &&
         (events_.next() < forecast_.next().earliest() || events_.next() <= clock))
    events_.handle_next();
  // If a communication certainly ends before the next queued event, no timer is needed. The
  // callback at the communication's end continues here.
  if (events_.stopped() || events_.next() == Events::NEVER ||
      forecast_.next().latest() < events_.next())
    return;
  if (events_.next() < wake_up_) {
    wake_up_ = events_.next();
    Timer::set(wake_up_, [this, date = wake_up_] {
      call([this, date] {
        if (date == wake_up_) wake_up_ = Events::NEVER;
        start_all(date);
        events_.advance(date);
        run_ahead();
      });
    });
  }
}

// Starts the communication as a call into SimGrid's maestro. Otherwise SimGrid would not report its
// end.
void OnSimGrid::start_now(std::size_t number) {
  if (directions_[number].cut) return;
  simgrid::kernel::actor::simcall_answered([&, &direction = directions_[number]] {
    direction.comm = s4u::Comm::sendto_init(direction.from, direction.to);
    direction.comm->set_payload_size(direction.bytes);
    direction.comm->set_data(reinterpret_cast<void*>(number));
    direction.comm->start();
  });
}

// Starts all communications due at `date`.
void OnSimGrid::start_all(double date) {
  for (; !starts_.empty() && starts_.front().first == date; starts_.pop_front())
    start_now(starts_.front().second);
}

// Starts the communication when SimGrid's clock reaches the date of tlab's clock. Communications of
// one date start in the order of the requests.
void OnSimGrid::start_later(std::size_t number) {
  const double date = events_.now();
  const bool timer_set = !starts_.empty() && starts_.back().first == date;
  starts_.emplace_back(date, number);
  if (timer_set) return;
  Timer::set(date, [this, date] { call([this, date] { start_all(date); }); });
}

void OnSimGrid::end(std::size_t number) {
  Direction& direction = directions_[number];
  last_ended_ = std::move(direction.comm);  // SimGrid still uses this object after the callback
  if (events_.stopped() || direction.cut) return;
  const double clock = s4u::Engine::get_clock();
  check_end(direction, clock, forecast_.end_of(number));
  events_.advance(clock);
  forecast_.end(number, events_.now());
  forecast_.settle();
  events_.handle(direction.arrived);
  run_ahead();
}

void OnSimGrid::check_end(const Direction& direction, double date,
                          const Forecast::End& expected) const {
  if (expected.contains(date)) return;
  throw base::InvariantBroken(
      fmt::format("link {} > {}: SimGrid ends the message of {} bytes that started at {:.12f} s "
                  "at {:.12f} s, expected {:.12f} to {:.12f} s",
                  direction.from->get_name().c_str(), direction.to->get_name().c_str(),
                  direction.bytes, direction.since, date, expected.earliest(), expected.latest()));
}

}  // namespace

std::unique_ptr<Carrier> make_simgrid(Events& events, Processes processes) {
  return std::make_unique<OnSimGrid>(events, processes);
}

}  // namespace machine
