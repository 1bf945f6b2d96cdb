#include "simulator/machine/engine.hpp"

#include <xbt/base.h>  // before version.h, which needs it

#include <simgrid/version.h>
#include <simgrid/kernel/Timer.hpp>
#include <simgrid/s4u.hpp>

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "simulator/machine/faults.hpp"

namespace machine {

namespace s4u = simgrid::s4u;
using simgrid::kernel::timer::Timer;

std::string simgrid_version() {
  int major = 0, minor = 0, patch = 0;
  sg_version_get(&major, &minor, &patch);
  return fmt::format("{}.{}.{}", major, minor, patch);
}

namespace {

struct Event {
  double date;
  std::uint64_t order;  // events of one date happen in the order they were asked for
  Engine::Callback callback;
  bool operator<(const Event& o) const {  // for a heap whose top is the next event
    return date != o.date ? date > o.date : order > o.order;
  }
};

}  // namespace

// Two sorts of events: ours, in a heap, and the ends of SimGrid's communications. A round of
// SimGrid costs more than most of our events, so we run ahead of its clock as far as no
// communication can end (conservative look-ahead), and ask it to wake us where we must stop,
// unless a communication surely ends before.
struct Engine::Impl {
  std::unique_ptr<s4u::Engine> engine;
  s4u::NetZone* zone = nullptr;
  std::vector<s4u::Host*> hosts;
  double fastest = 1;                                        // bytes/s: no communication is faster,
  double slowest = std::numeric_limits<double>::infinity();  // and none slower

  double now = 0;                                            // may be ahead of SimGrid's clock
  double horizon = std::numeric_limits<double>::infinity();  // no communication ends before
  std::vector<Event> heap;
  std::vector<Callback> soon, soon_now;
  std::uint64_t asked = 0, sent = 0, handled = 0;
  double wake_up = std::numeric_limits<double>::infinity();  // a SimGrid timer is set for then
  bool stopped = false;

  // Communications, in slots that are used again: SimGrid is given a slot's number.
  struct Flight {
    s4u::CommPtr comm;
    Callback arrived;
    int from = 0, to = 0;
    std::uint64_t bytes = 0, id = 0;
  };
  // When a communication can end. Those that have ended are dropped when they come to the top.
  struct Bounds {
    double earliest, latest;
    std::size_t slot;
    std::uint64_t id;
    bool operator<(const Bounds& o) const { return earliest > o.earliest; }
  };
  std::vector<Bounds> ends;
  std::vector<Flight> flights;
  s4u::CommPtr last_ended;
  std::vector<std::size_t> free_slots;

  void handle(Callback callback) {
    ++handled;
    callback();
    while (!soon.empty() && !stopped) {
      soon_now.swap(soon);
      for (auto& then : soon_now) then();
      soon_now.clear();
    }
  }

  // Our events up to where a communication might end first. What SimGrid's clock has reached is
  // certain: communications that end there have ended.
  void run_ahead() {
    const double clock = s4u::Engine::get_clock();
    while (!ends.empty() && flights[ends.front().slot].id != ends.front().id) {
      std::ranges::pop_heap(ends, std::less<>());
      ends.pop_back();
    }
    horizon = ends.empty() ? std::numeric_limits<double>::infinity() : ends.front().earliest;
    while (!heap.empty() && !stopped &&
           (heap.front().date < horizon || heap.front().date <= clock)) {
      std::ranges::pop_heap(heap, std::less<>());
      const Event event = heap.back();
      heap.pop_back();
      now = event.date;
      handle(event.callback);
    }
    // A communication that surely ends before our next event brings us back here in time.
    if (heap.empty() || stopped || (!ends.empty() && ends.front().latest < heap.front().date))
      return;
    if (heap.front().date < wake_up) {
      wake_up = heap.front().date;
      Timer::set(wake_up, [this, date = wake_up] {
        if (date == wake_up) wake_up = std::numeric_limits<double>::infinity();
        now = std::max(now, date);
        run_ahead();
      });
    }
  }

  void start(std::size_t slot) {
    Flight& flight = flights[slot];
    flight.comm = s4u::Comm::sendto_init(hosts[flight.from], hosts[flight.to]);
    flight.comm->set_payload_size(flight.bytes);
    flight.comm->set_data(reinterpret_cast<void*>(slot));
    flight.comm->start();
  }

  void end(std::size_t slot) {
    Flight ended = std::exchange(flights[slot], {});
    free_slots.push_back(slot);
    last_ended = std::move(ended.comm);  // SimGrid still uses it when we return
    if (stopped) return;
    now = std::max(now, s4u::Engine::get_clock());
    handle(ended.arrived);
    run_ahead();
  }
};

Engine::Engine() : impl_(std::make_unique<Impl>()) {
  static int argc = 3;
  static char name[] = "tlab", to[] = "--log=root.app:file:/dev/null",
              only[] = "--log=root.thres:critical";
  static char* argv[] = {name, to, only, nullptr};
  impl_->engine = std::make_unique<s4u::Engine>(&argc, argv);
  // Plain fluid links: no TCP corrections, no cross traffic. Time is resolved to a picosecond.
  for (const char* setting :
       {"network/model:CM02", "network/bandwidth-factor:1", "network/latency-factor:1",
        "network/crosstraffic:0", "network/TCP-gamma:0", "surf/precision:1e-12"})
    s4u::Engine::set_config(setting);
  impl_->zone = s4u::create_full_zone("machine");
  s4u::Activity::on_completion_cb([impl = impl_.get()](const s4u::Activity& activity) {
    impl->end(reinterpret_cast<std::size_t>(activity.get_data<void>()));
  });
}

Engine::~Engine() = default;

int Engine::add_processor(const std::string& name) {
  impl_->hosts.push_back(impl_->zone->create_host(name, "1f")->seal());
  return static_cast<int>(impl_->hosts.size()) - 1;
}

void Engine::add_link(int a, int b, LinkRates rates) {
  auto& zone = *impl_->zone;
  impl_->fastest = std::max(impl_->fastest, rates.one_way);
  impl_->slowest = std::min({impl_->slowest, rates.one_way, rates.both_ways / 2});
  const auto name = fmt::format("{}-{}", a, b);
  auto* there = zone.create_link(name + ">", rates.one_way)->seal();
  auto* back = zone.create_link(name + "<", rates.one_way)->seal();
  auto* shared = zone.create_link(name + "=", rates.both_ways)->seal();
  auto route = [&](int from, int to, const s4u::Link* own) {
    zone.add_route(impl_->hosts[from]->get_netpoint(), impl_->hosts[to]->get_netpoint(), nullptr,
                   nullptr, {s4u::LinkInRoute(own), s4u::LinkInRoute(shared)}, false);
  };
  route(a, b, there);
  route(b, a, back);
}

Seconds Engine::now() const { return {impl_->now}; }

void Engine::at(Seconds date, Callback callback) {
  impl_->heap.push_back({date.value, impl_->asked++, std::move(callback)});
  std::ranges::push_heap(impl_->heap, std::less<>());
}

void Engine::soon(Callback callback) { impl_->soon.push_back(std::move(callback)); }

void Engine::transfer(int from, int to, std::uint64_t bytes, Callback arrived) {
  Impl& impl = *impl_;
  if (impl.free_slots.empty()) {
    impl.flights.emplace_back();
    impl.free_slots.push_back(impl.flights.size() - 1);
  }
  const std::size_t slot = impl.free_slots.back();
  impl.free_slots.pop_back();
  const std::uint64_t id = ++impl.sent;
  impl.flights[slot] = {{}, std::move(arrived), from, to, bytes, id};
  // A hair early, or late, lest SimGrid round its date.
  const double earliest = impl.now + static_cast<double>(bytes) / impl.fastest * (1 - 1e-9);
  const double latest = impl.now + static_cast<double>(bytes) / impl.slowest * (1 + 1e-9) + 1e-11;
  impl.ends.push_back({earliest, latest, slot, id});
  std::ranges::push_heap(impl.ends, std::less<>());
  impl.horizon = std::min(impl.horizon, earliest);
  if (impl.now > s4u::Engine::get_clock())
    Timer::set(impl.now, [&impl, slot] { impl.start(slot); });
  else
    impl.start(slot);
}

std::uint64_t Engine::run() {
  impl_->zone->seal();
  at({0}, [] {});  // and after it whatever was asked for soon
  impl_->run_ahead();
  impl_->engine->run();
  return impl_->handled;
}

void Engine::stop() { impl_->stopped = true; }

}  // namespace machine
