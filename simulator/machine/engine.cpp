#include "simulator/machine/engine.hpp"

#include <xbt/base.h>  // before version.h, which needs it

#include <simgrid/version.h>
#include <simgrid/kernel/Timer.hpp>
#include <simgrid/s4u.hpp>
#include <simgrid/simix.hpp>

#include <algorithm>
#include <csignal>
#include <deque>
#include <exception>
#include <limits>

#include "simulator/machine/faults.hpp"
#include "simulator/machine/forecast.hpp"

namespace machine {

namespace s4u = simgrid::s4u;
using simgrid::kernel::timer::Timer;

std::string simgrid_version() {
  int major = 0, minor = 0, patch = 0;
  sg_version_get(&major, &minor, &patch);
  return fmt::format("{}.{}.{}", major, minor, patch);
}

namespace {

volatile std::sig_atomic_t stop_requested = 0;

// SimGrid takes some signals, and what is done with an uncaught exception, for itself when it
// starts: here they stay the program's.
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
  struct sigaction kept_[3];
  std::terminate_handler terminate_ = std::get_terminate();
};

constexpr std::uint64_t FIRST = 1u << 31;  // orders from here on are not asked for as first

struct Event {
  double date;
  std::uint64_t order;  // events of one date happen in the order they were asked for
  Engine::Callback callback;
  bool operator<(const Event& o) const {  // for a heap whose top is the next event
    return date != o.date ? date > o.date : order > o.order;
  }
};

// What the callback of a deadlock throws, see Engine::run.
struct AllWait {};

class ActorCoroutine;

// An actor of SimGrid that runs bodies, one after the other: the branches of a PAR come and go, and
// SimGrid frees actors that have ended only when its clock advances.
struct Hand {
  s4u::SemaphorePtr own_turn = s4u::Semaphore::create(0), others_turn = s4u::Semaphore::create(0);
  ActorCoroutine* works_for = nullptr;
};
using Hands = std::vector<std::shared_ptr<Hand>>;

// A body on an actor. Actors go on when SimGrid's maestro lets them, one after the other; a
// semaphore for each side makes the two run by turns.
class ActorCoroutine final : public Coroutine {
 public:
  // `idle` are the host's. The actor has the name of the first body that it runs.
  ActorCoroutine(s4u::Engine& engine, s4u::Host* host, Hands& idle, std::string name, Body body)
      : engine_(engine), host_(host), idle_(idle), name_(std::move(name)), body_(std::move(body)) {}

  void resume() override {
    if (hand_) {
      hand_->own_turn->release();
    } else if (idle_.empty()) {
      hand_ = std::make_shared<Hand>();
      hand_->works_for = this;
      s4u::Actor::create(name_, host_, [hand = hand_, &idle = idle_] { work(hand, idle); });
    } else {
      hand_ = std::move(idle_.back());
      idle_.pop_back();
      hand_->works_for = this;
      hand_->own_turn->release();
    }
    if (s4u::Actor::is_maestro())  // after the run
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
      hand->others_turn->release();  // from here on the coroutine may be gone
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

}  // namespace

// There are two sorts of events: ours, in a heap, and the ends of SimGrid's communications. A round
// of SimGrid costs more than most of our events, so we run ahead of its clock as far as no
// communication can end (conservative look-ahead), and ask it to wake us where we must stop,
// unless a communication surely ends before.
struct Engine::Impl {
  std::unique_ptr<s4u::Engine> engine;
  s4u::NetZone* zone = nullptr;
  std::vector<s4u::Host*> hosts;

  double now = 0;  // may be ahead of SimGrid's clock
  std::vector<Event> heap;
  std::vector<Callback> soon, soon_now;
  std::uint64_t asked_first = 0, asked = FIRST, handled = 0;
  double wake_up = std::numeric_limits<double>::infinity();  // a SimGrid timer is set for then
  bool stopped = false, ignored = false;
  double last_useful = 0;  // date
  double until = std::numeric_limits<double>::infinity();
  Engine::End end_reason = Engine::End::no_event_left;

  // Directions of links, by the numbers of the forecast and of SimGrid's communications.
  struct Direction {
    int from, to;
    s4u::CommPtr comm = {};  // under way
    std::uint64_t bytes = 0;
    double since = 0;
    Callback arrived = {};
    bool cut = false;  // what SimGrid still tells of it is ignored
  };
  std::vector<Direction> directions;
  std::vector<std::vector<std::size_t>> leaving;  // by processor
  Forecast forecast;
  std::deque<std::pair<double, std::size_t>> starts;  // to come: date, direction
  s4u::CommPtr last_ended;

  // With actors our scheduler is an actor, too, since it has to wait for their turns to end: it
  // does what SimGrid calls back for.
  bool has_actors = false;
  std::deque<Hands> idle;    // by processor
  s4u::SemaphorePtr called;  // as often as there are calls; once more to end it
  std::deque<Callback> calls;
  std::exception_ptr failure;  // of a call

  template <class Call>
  void call(Call call) {
    if (!called) return call();
    calls.emplace_back(call);
    called->release();
  }

  void start_scheduler() {
    called = s4u::Semaphore::create(0);
    s4u::Actor::create("scheduler", hosts.front(), [this] {
      for (called->acquire(); !calls.empty(); called->acquire()) {
        Callback next = calls.front();
        calls.pop_front();
        try {
          next();
        } catch (...) {
          failure = std::current_exception();
          stopped = true;
        }
      }
    });
  }

  ~Impl() {
    if (!called) return;
    called->release();
    for (const auto& hands : idle)
      for (const auto& hand : hands) hand->own_turn->release();
    engine->run_until(s4u::Engine::get_clock());
  }

  void stop(Engine::End why) {
    if (!stopped) end_reason = why;
    stopped = true;
  }

  void handle(Callback callback) {
    if (now > until) {
      now = until;
      return stop(Engine::End::until);
    }
    if (stop_requested != 0) return stop(Engine::End::requested);
    ++handled;
    ignored = false;
    callback();
    if (!ignored) last_useful = now;
    while (!soon.empty() && !stopped) {
      soon_now.swap(soon);
      for (auto& then : soon_now) then();
      soon_now.clear();
    }
  }

  // Handles our events up to where a communication might end first. What SimGrid's clock has
  // reached is certain: communications that end there have ended.
  void run_ahead() {
    const double clock = s4u::Engine::get_clock();
    while (!heap.empty() && !stopped &&
           (heap.front().date < forecast.next().earliest || heap.front().date <= clock)) {
      std::ranges::pop_heap(heap, std::less<>());
      const Event event = heap.back();
      heap.pop_back();
      now = event.date;
      handle(event.callback);
    }
    // A communication that surely ends before our next event brings us back here in time.
    if (heap.empty() || stopped || forecast.next().latest < heap.front().date) return;
    if (heap.front().date < wake_up) {
      wake_up = heap.front().date;
      Timer::set(wake_up, [this, date = wake_up] {
        call([this, date] {
          if (date == wake_up) wake_up = std::numeric_limits<double>::infinity();
          start_all(date);
          now = std::max(now, date);
          run_ahead();
        });
      });
    }
  }

  // SimGrid tells the end of a communication if its maestro has started it.
  void start(std::size_t number) {
    if (directions[number].cut) return;
    simgrid::kernel::actor::simcall_answered([&, &direction = directions[number]] {
      direction.comm = s4u::Comm::sendto_init(hosts[direction.from], hosts[direction.to]);
      direction.comm->set_payload_size(direction.bytes);
      direction.comm->set_data(reinterpret_cast<void*>(number));
      direction.comm->start();
    });
  }

  // Starts what was to start at that date, once.
  void start_all(double date) {
    for (; !starts.empty() && starts.front().first == date; starts.pop_front())
      start(starts.front().second);
  }

  // Starts it when SimGrid's clock has come so far; those of one date in the order they were asked
  // for.
  void start_later(std::size_t number) {
    const bool timer_set = !starts.empty() && starts.back().first == now;
    starts.emplace_back(now, number);
    if (timer_set) return;
    Timer::set(now, [this, date = now] { call([this, date] { start_all(date); }); });
  }

  std::size_t number_of(int from, int to) const {
    return *std::ranges::find(leaving[from], to, [&](std::size_t n) { return directions[n].to; });
  }

  void ask(double date, std::uint64_t order, Callback callback) {
    heap.push_back({date, order, callback});
    std::ranges::push_heap(heap, std::less<>());
  }

  void end(std::size_t number) {
    Direction& direction = directions[number];
    last_ended = std::move(direction.comm);  // SimGrid still uses it when we return
    if (stopped || direction.cut) return;
    const double clock = s4u::Engine::get_clock();
    now = std::max(now, clock);
    check_end(direction, clock, forecast.end(number, now));
    handle(direction.arrived);
    run_ahead();
  }

  void check_end(const Direction& direction, double date, const Forecast::Bounds& bounds) const {
    if (bounds.contain(date)) return;
    throw base::InvariantBroken(fmt::format(
        "link {} > {}: SimGrid ends the message of {} bytes that started at {:.12f} s "
        "at {:.12f} s, expected {:.12f} to {:.12f} s",
        hosts[direction.from]->get_name().c_str(), hosts[direction.to]->get_name().c_str(),
        direction.bytes, direction.since, date, bounds.earliest, bounds.latest));
  }
};

Engine::Engine(Processes processes) : impl_(std::make_unique<Impl>()) {
  static int argc = 3;
  static char name[] = "tlab", to[] = "--log=root.app:file:/dev/null",
              only[] = "--log=root.thres:critical";
  static char* argv[] = {name, to, only, nullptr};
  {
    const KeptSignals kept;
    impl_->engine = std::make_unique<s4u::Engine>(&argc, argv);
  }
  // Plain fluid links: no TCP corrections, no cross traffic. Time is resolved to a picosecond.
  for (const char* setting :
       {"network/model:CM02", "network/bandwidth-factor:1", "network/latency-factor:1",
        "network/crosstraffic:0", "network/TCP-gamma:0", "surf/precision:1e-12"})
    s4u::Engine::set_config(setting);
  impl_->zone = s4u::create_full_zone("machine");
  s4u::Activity::on_completion_cb([impl = impl_.get()](const s4u::Activity& activity) {
    impl->call([impl, number = reinterpret_cast<std::size_t>(activity.get_data<void>())] {
      impl->end(number);
    });
  });
  impl_->has_actors = processes == Processes::actors;
  if (!impl_->has_actors) return;
  const auto stack = fmt::format("contexts/stack-size:{}", Coroutine::STACK_BYTES / 1024);
  for (const std::string& setting : {stack, std::string("contexts/guard-size:0")})
    s4u::Engine::set_config(setting);
  s4u::Engine::on_deadlock_cb([] { throw AllWait(); });
}

Engine::~Engine() = default;

int Engine::add_processor(const std::string& name) {
  impl_->hosts.push_back(impl_->zone->create_host(name, "1f")->seal());
  impl_->leaving.emplace_back();
  impl_->idle.emplace_back();
  return static_cast<int>(impl_->hosts.size()) - 1;
}

void Engine::add_link(int a, int b, LinkRates rates) {
  auto& zone = *impl_->zone;
  const std::size_t number = impl_->forecast.add_link(rates.one_way, rates.both_ways);
  impl_->leaving[a].push_back(number);
  impl_->leaving[b].push_back(number + 1);
  impl_->directions.push_back({a, b});
  impl_->directions.push_back({b, a});
  const auto name = fmt::format("{}-{}", a, b);
  const auto rate = [rates](double, int messages) {
    return messages > 1 ? rates.both_ways : rates.one_way;
  };
  auto* link = zone.create_link(name, rates.both_ways)
                   ->set_sharing_policy(s4u::Link::SharingPolicy::NONLINEAR, rate)
                   ->seal();
  zone.add_route(impl_->hosts[a]->get_netpoint(), impl_->hosts[b]->get_netpoint(), nullptr, nullptr,
                 {s4u::LinkInRoute(link)}, true);
}

std::unique_ptr<Coroutine> Engine::make_coroutine(int processor, const std::string& name,
                                                  Coroutine::Body body) {
  Impl& impl = *impl_;
  if (!impl.has_actors) return make_fiber(std::move(body));
  return std::make_unique<ActorCoroutine>(*impl.engine, impl.hosts.at(processor),
                                          impl.idle.at(processor), name, std::move(body));
}

Seconds Engine::now() const { return {impl_->now}; }

Seconds Engine::until() const { return {impl_->until}; }

void Engine::at(Seconds date, Callback callback) {
  impl_->ask(date.value, impl_->asked++, callback);
}

void Engine::first_at(Seconds date, Callback callback) {
  impl_->ask(date.value, impl_->asked_first++, callback);
}

void Engine::soon(Callback callback) { impl_->soon.push_back(std::move(callback)); }

void Engine::transfer(int from, int to, std::uint64_t bytes, Callback arrived) {
  Impl& impl = *impl_;
  const std::size_t number = impl.number_of(from, to);
  impl.directions[number].bytes = bytes;
  impl.directions[number].since = impl.now;
  impl.directions[number].arrived = arrived;
  impl.forecast.start(number, static_cast<double>(bytes), impl.now);
  if (impl.now > s4u::Engine::get_clock())
    impl.start_later(number);
  else
    impl.start(number);
}

void Engine::cut(int a, int b) {
  for (const std::size_t number : {impl_->number_of(a, b), impl_->number_of(b, a)}) {
    impl_->directions[number].cut = true;
    impl_->forecast.end(number, impl_->now);
  }
}

Engine::End Engine::run(Seconds until) {
  impl_->until = until.value;
  {
    const KeptSignals kept;
    impl_->zone->seal();
  }
  at({0}, [] {});  // and after it whatever was asked for soon
  if (impl_->has_actors && !impl_->hosts.empty()) impl_->start_scheduler();
  impl_->call([this] { impl_->run_ahead(); });
  try {
    impl_->engine->run();
  } catch (const AllWait&) {  // actors that wait when nothing can happen: SimGrid would end them
  }
  if (impl_->failure) std::rethrow_exception(impl_->failure);
  if (impl_->end_reason == End::no_event_left) rewind();
  return impl_->end_reason;
}

void Engine::rewind() { impl_->now = impl_->last_useful; }

void Engine::ignore_event() { impl_->ignored = true; }

void Engine::stop() { impl_->stop(End::stopped); }

std::uint64_t Engine::handled() const { return impl_->handled; }

std::uint64_t Engine::asked() const { return impl_->asked + impl_->soon.size(); }

void request_stop() { stop_requested = 1; }

}  // namespace machine
