#pragma once
// Functions of a program for a live page, which shows the run and takes commands of its user.
#include <any>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "simulator/machine/machine.hpp"

namespace observe {

/// Functions that a program provides for a live page. They are called between events and take no
/// simulated time.
struct ControlPanel {
  struct Picture {
    int width = 0, height = 0;
    /// Returns the picture as it is now, 3 bytes per pixel.
    std::function<const std::vector<std::uint8_t>*()> rgb8;
  };
  /// A quantity that changes during the run, such as the number of rays or the length of a queue.
  struct Gauge {
    std::string name, help;
    std::function<double()> value;
  };
  /// A changing quantity of one processor, such as the number of messages in its router, or of
  /// bytes in its cache.
  struct Reading {
    std::string name;
    double value = 0;
  };
  /// Returns the present quantities of a processor, given by its id in the machine.
  using Inspect = std::function<std::vector<Reading>(int processor)>;
  /// Takes a command of the user, which is a record of the program's list "order". The order takes
  /// effect at the next tick of the user's clock that is later than both the present date and
  /// `after`. Returns the time of this tick, as the value of at_s in the record. Throws
  /// base::BadInput if the record is invalid, with the messages for an experiment file.
  using TakeOrder = std::function<double(const std::any& record, machine::Seconds after)>;

  /// The id in the machine of each processor of the network. Empty if ids equal the network's
  /// numbers.
  std::vector<int> network;
  std::optional<Picture> picture;
  /// Computes the final picture of the run with the sequential renderer; rows start at the top.
  /// Gives up, with an empty result, when `goes_on` returns false. Another thread may call this
  /// function while the machine runs.
  std::function<std::vector<std::uint8_t>(const std::function<bool()>& goes_on)> sequential;
  std::vector<Gauge> gauges;
  std::function<double()> count_rays;  ///< empty (no function) if the program traces no rays
  /// Functions that each return the quantities of a processor; the list may be empty.
  std::vector<Inspect> inspections;
  TakeOrder take_order;  ///< empty (no function) if the program takes no orders
  /// Makes the program refuse further commands of the live page. Orders of the experiment file
  /// remain.
  std::function<void()> close_orders;
  /// Limits in force, as a record of the program's list "stage".
  std::function<std::any()> limits;
  std::function<std::string()> phase;  ///< short description of what the program is doing
  /// True if the run can continue only after a command of the user.
  std::function<bool()> waits_for_user;
  std::function<bool()> is_complete;  ///< true if the program has nothing left to do but to end
};

}  // namespace observe
