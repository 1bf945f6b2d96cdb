#pragma once
// Live view of a run: the data that a program shows, and the orders that its user may give.
#include <any>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "simulator/machine/machine.hpp"

namespace observe {

/// Data shown by a program. Its functions are called between two events and take no simulated time.
struct View {
  struct Picture {
    int width = 0, height = 0;
    std::function<const std::vector<std::uint8_t>*()> rgb8;  ///< the display's current picture
  };
  /// A number that changes: "rays", a queue's length.
  struct Gauge {
    std::string name, help;
    std::function<double()> value;
  };
  /// A changing number of one processor: contents of its router or its cache.
  struct Reading {
    std::string name;
    double value = 0;
  };
  using Inspect = std::function<std::vector<Reading>(int processor)>;  ///< its id in the machine
  /// Takes an order of the user, a record of the program's list "order". The order comes at the
  /// first tick of the user's clock after `after` (not before now); returns that time as the
  /// record's at_s. Throws base::BadInput like the experiment file for an invalid order.
  using TakeOrder = std::function<double(const std::any& record, machine::Seconds after)>;

  std::vector<int> network;  ///< ids of the network's processors in the machine; empty: the same
  std::optional<Picture> picture;
  /// The last picture by the sequential renderer, rows from the top; empty if `goes_on` returns
  /// false meanwhile. Another thread may call it while the machine runs.
  std::function<std::vector<std::uint8_t>(const std::function<bool()>& goes_on)> sequential;
  std::vector<Gauge> gauges;
  std::vector<Inspect> inspections;      ///< results may be empty for a processor
  TakeOrder take_order;                  ///< only if the program has a user
  std::function<void()> close_orders;    ///< ends manual orders: the user leaves after the file's
  std::function<std::string()> phase;    ///< current activity, in a few words
  std::function<bool()> waits_for_user;  ///< true: nothing happens without an order of the user
  std::function<bool()> is_complete;     ///< true: all is done, only the end of the run remains
};

/// Read-only observer of a run, on any engine.
struct Onlooker {
  virtual ~Onlooker() = default;
  /// Called before the machine runs; `machine` and `view` live until `end`.
  virtual void begin(const machine::Machine& machine, const View& view) = 0;
  /// Called when View::picture, if there is one, is about to change after `now_s`.
  virtual void before_change(double now_s) = 0;
  /// Called after the run.
  virtual void end(double now_s) = 0;
};

/// Observer that also controls the pace of a run, for machines with Links::direct.
struct Spectator : machine::Pace {
  /// Called before the machine runs; `machine` and `view` live until `end`.
  virtual void begin(machine::Machine& machine, const View& view) = 0;
  /// Called after the run; `fault` is the reason if it failed, else empty.
  virtual void end(const std::string& fault) = 0;
};

}  // namespace observe
