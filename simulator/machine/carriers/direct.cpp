#include <algorithm>
#include <vector>

#include "base/errors.hpp"
#include "simulator/machine/carriers/carrier.hpp"
#include "simulator/machine/carriers/forecast.hpp"

namespace machine {

namespace {

class Direct final : public Carrier {
 public:
  explicit Direct(Events& events) : events_(events) {}

  void add_processor(const std::string& /*name*/) override {}
  std::size_t add_link(int /*a*/, int /*b*/, LinkRates rates, std::size_t rank) override {
    arrived_.resize(arrived_.size() + 2);
    return forecast_.add_link(rates.one_way, rates.both_ways, rank);
  }
  std::unique_ptr<Coroutine> make_coroutine(int /*processor*/, const std::string& /*name*/,
                                            Coroutine::Body body) override {
    return make_fiber(std::move(body));
  }

  void start(std::size_t direction, std::uint64_t bytes, Callback arrived) override {
    arrived_[direction] = arrived;
    forecast_.start(direction, static_cast<double>(bytes), events_.now());
  }
  double left_of(std::size_t direction, double date) const override {
    return forecast_.left(direction, date);
  }
  void cut(std::size_t direction) override { forecast_.end(direction, events_.now()); }

  void run() override { run_before({}); }

  Moment next() override {
    forecast_.settle();
    return std::min(events_.next_moment(), forecast_.next_moment());
  }

  void run_before(const Moment& bound) override {
    events_.finish();
    while (!events_.stopped()) {
      if (events_.next() <= events_.now()) {
        if (events_.next() >= bound.date && events_.next_moment() >= bound) return;
        events_.handle_next();
        continue;
      }
      // Predicts the ends of messages only before the clock advances, because several messages may
      // start and end at one date.
      forecast_.settle();
      const double next_end = forecast_.next_date();
      if (events_.pace() && std::min(events_.next(), next_end) > events_.now() && !may_go_on())
        continue;
      if (std::min(events_.next(), next_end) >= bound.date &&
          std::min(events_.next_moment(), forecast_.next_moment()) >= bound)
        return;
      if (events_.next() <= next_end) {
        events_.handle_next();
        continue;
      }
      const std::size_t direction = forecast_.next().direction;
      events_.advance(next_end);
      forecast_.end(direction, events_.now());
      events_.handle(arrived_[direction]);
    }
  }

 private:
  bool may_go_on() {
    return events_.pace()->before(std::min(events_.next(), forecast_.next_date())) &&
           !events_.stopped();
  }

  Events& events_;
  Forecast forecast_;
  std::vector<Callback> arrived_;  // indexed by direction
};

}  // namespace

std::unique_ptr<Carrier> make_direct(Events& events, Processes processes) {
  if (processes == Processes::actors)
    throw base::InvariantBroken(
        "found actors with the direct engine, expected them with SimGrid only");
  return std::make_unique<Direct>(events);
}

}  // namespace machine
