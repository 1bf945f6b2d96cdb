#pragma once
// Control panel of a program: the data that it shows while it runs, and the orders that it takes.
#include <any>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "simulator/machine/machine.hpp"

namespace observe {

/// Data shown by a program. Its functions are called between two events and take no simulated time.
struct ControlPanel {
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

}  // namespace observe
