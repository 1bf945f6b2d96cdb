#pragma once
// The user's orders, sorted by time: those of the script (the experiment file) and, in a live run,
// orders that a person gives by hand. A manual order has the same effect as if it were in the
// script.
#include <algorithm>
#include <any>
#include <cmath>
#include <deque>

#include "simulator/occam/process.hpp"
#include "simulator/ray_tracing/session.hpp"

namespace ray_tracing {

template <class Limits>
class Orders {
 public:
  using Order = ray_tracing::Order<Limits>;

  /// `is_live` allows manual orders. If they are not allowed, the user leaves after the last order
  /// of the script. The list of orders always ends with a Leave.
  Orders(const std::vector<Order>& script, bool is_live)
      : orders_(script.begin(), script.end()), is_open_(is_live) {}

  bool has_any() const { return is_open_ || !orders_.empty(); }

  /// Called by the process that stands for the user: waits until the next order is due, and returns
  /// the order's number, from 0. The times of orders count from the date `begun`.
  std::size_t next(machine::Seconds begun) {
    user_ = &machine::this_process();
    begun_ = begun;
    if (next_ < orders_.size())
      wait_for_time();
    else if (is_open_)
      wait_for_manual_order();
    if (next_ == orders_.size()) orders_.push_back({{}, Leave{}});
    return next_++;
  }
  const Order& operator[](std::size_t number) const { return orders_.at(number); }

  /// Inserts a manual order, and returns its time as at_s (see observe::ControlPanel::TakeOrder).
  /// Called from outside the machine, between events. `check` throws for orders that the program
  /// does not allow.
  double take(const OrderRecord<Limits>& record, machine::Seconds after,
              const std::function<void(const std::vector<Order>&)>& check) {
    if (!user_ || !is_open_)
      throw base::BadInput(
          user_ ? "[[order]]: found one after the picture was complete, expected it earlier"
                : "[[order]]: found one before the first task, expected it later");
    const double tick_s = occam::date_of(*user_, 1).value;
    // The own time of the user's process (its date including charged cycles) may be ahead of the
    // clock. The process has then already found that no order is due before its own time, so the
    // new order must be later.
    const bool is_blocked = user_->state() == machine::Process::State::blocked;
    const auto own = is_blocked ? user_->blocked_since() : user_->own_time();
    const double from_s = std::max(after, own).value;
    const auto tick = static_cast<std::int64_t>(std::floor(from_s / tick_s)) + 1;
    const machine::Seconds date = occam::date_of(*user_, tick);
    OrderRecord<Limits> dated = record;
    dated.at_s = (date - begun_).value;
    const auto order = make_order(dated);
    std::vector<Order> script(orders_.begin(), orders_.end());
    const auto place = std::upper_bound(
        script.begin() + static_cast<std::ptrdiff_t>(next_), script.end(), order.at,
        [](machine::Seconds at, const Order& other) { return at < other.at; });
    if (place != script.begin() && std::holds_alternative<Leave>(std::prev(place)->what))
      throw base::BadInput("[[order]]: found one after the user had left, expected it earlier");
    script.insert(place, order);
    check(script);
    orders_.assign(script.begin(), script.end());
    wake(date);
    return dated.at_s;
  }

  /// Lets the user of a live page give orders. `is_null` returns true if no step within the limits
  /// is left. For `check` see take().
  void show(observe::ControlPanel& view, std::function<bool()> is_null,
            std::function<void(const std::vector<Order>&)> check) {
    view.waits_for_user = [this, is_null] { return is_null() && waits_for_manual_order(); };
    view.close_orders = [this] { close(); };
    view.take_order = [this, check](const std::any& record, machine::Seconds after) {
      return take(std::any_cast<const OrderRecord<Limits>&>(record), after, check);
    };
  }

  /// True if the user's process waits for a manual order and has not been given one.
  bool waits_for_manual_order() const { return waits_for_manual_order_ && next_ == orders_.size(); }
  /// Allows no further manual orders, so that the user leaves after the last order in the list.
  void close() { is_open_ = false; }

 private:
  // Waits as occam::wait_until does, with two differences: the wait ends before all other events of
  // its date, no matter when it began, and a manual order may end it earlier.
  void wait_for_time() {
    const auto& timer = user_->processor().model().timer;
    const bool is_past = user_->own_time() >= date_of_next();
    user_->charge(is_past ? timer.wait_past : timer.wait_future);
    block_until_time();
  }

  void wait_for_manual_order() {
    user_->charge(user_->processor().model().timer.wait_future);
    user_->sync();
    waits_for_manual_order_ = true;
    if (next_ == orders_.size())
      block();
    else  // an order has arrived meanwhile
      block_until_time();
    waits_for_manual_order_ = false;
  }

  machine::Seconds date_of_next() const {
    return occam::date_of(*user_, occam::ticks(begun_ + orders_[next_].at));
  }

  void block_until_time() {
    const auto date = date_of_next();
    if (user_->now() >= date) return;
    user_->processor().wake_first_at(date, *user_, user_->waits() + 1);
    block();
  }

  struct UserWait : machine::Wait {
    std::string describe() const override { return "the user's next order"; }
  };
  void block() {
    UserWait wait;
    waits_for_order_ = true;
    user_->block(wait);
    waits_for_order_ = false;
  }

  // Wakes the user's process if it waits for a manual order or for the time of a later order. A
  // process that is still busy with the previous order finds the new order without being woken.
  void wake(machine::Seconds date) {
    if (waits_for_order_) user_->processor().wake_first_at(date, *user_, user_->waits());
  }

  std::deque<Order> orders_;
  std::size_t next_ = 0;
  bool is_open_;
  machine::Process* user_ = nullptr;
  machine::Seconds begun_{};
  bool waits_for_manual_order_ = false, waits_for_order_ = false;
};

}  // namespace ray_tracing
