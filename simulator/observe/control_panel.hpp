#pragma once
// Live view of a run: data provided by a program, and commands of its user.
#include <any>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "simulator/machine/machine.hpp"

namespace observe {

/// The data that a program provides. Its functions are called between events and take no simulated
/// time.
struct ControlPanel {
  struct Picture {
    int width = 0, height = 0;
    std::function<const std::vector<std::uint8_t>*()> rgb8;  ///< the present picture
  };
  /// A varying quantity such as the number of rays or the length of a queue.
  struct Gauge {
    std::string name, help;
    std::function<double()> value;
  };
  /// A varying quantity of one processor, such as the number of messages in its router or of bytes
  /// in its cache.
  struct Reading {
    std::string name;
    double value = 0;
  };
  /// Returns the readings of a processor, given by its id in the machine.
  using Inspect = std::function<std::vector<Reading>(int processor)>;
  /// Takes a command of the user: a record of the program's list "order". The order takes effect at
  /// the first tick of the user's clock after both now and `after`. Returns the time of this tick
  /// as at_s of the record. Throws base::BadInput, with the messages of the experiment file, if the
  /// record is invalid.
  using TakeOrder = std::function<double(const std::any& record, machine::Seconds after)>;

  /// By processor of the network: its id in the machine. Empty if numbers and ids are the same.
  std::vector<int> network;
  std::optional<Picture> picture;
  /// Computes the latest picture with the sequential renderer; rows start at the top. Stops with an
  /// empty result when `goes_on` returns false. Another thread may call it while the machine runs.
  std::function<std::vector<std::uint8_t>(const std::function<bool()>& goes_on)> sequential;
  std::vector<Gauge> gauges;
  std::function<double()> count_rays;    ///< empty if the program traces no rays
  std::vector<Inspect> inspections;      ///< each may return an empty list for a processor
  TakeOrder take_order;                  ///< empty for a program without a user
  std::function<void()> close_orders;    ///< ends manual commands; only those of the file remain
  std::function<std::string()> phase;    ///< short description of the present activity
  std::function<bool()> waits_for_user;  ///< true: only a command of the user lets the run continue
  std::function<bool()> is_complete;     ///< true: the program has nothing left to do but to end
};

}  // namespace observe
