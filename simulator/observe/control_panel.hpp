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
  /// A varying quantity of one processor, such as the contents of its router or cache.
  struct Reading {
    std::string name;
    double value = 0;
  };
  using Inspect = std::function<std::vector<Reading>(int processor)>;  ///< takes the machine's id
  /// Takes a command of the user: a record of the program's list "order". It takes effect at the
  /// first tick of the user's clock after the later of now and `after`. Returns that time, the
  /// record's at_s. Throws base::BadInput, with the messages of the experiment file, if the record
  /// is invalid.
  using TakeOrder = std::function<double(const std::any& record, machine::Seconds after)>;

  /// The network's processors, as ids in the machine. Empty if the numbers are the same.
  std::vector<int> network;
  std::optional<Picture> picture;
  /// Computes the latest picture with the sequential renderer; rows start at the top. Stops with an
  /// empty result when `goes_on` returns false. Another thread may call it while the machine runs.
  std::function<std::vector<std::uint8_t>(const std::function<bool()>& goes_on)> sequential;
  std::vector<Gauge> gauges;
  std::vector<Inspect> inspections;      ///< each may return an empty list for a processor
  TakeOrder take_order;                  ///< empty for a program without a user
  std::function<void()> close_orders;    ///< ends manual commands, so that only the file's remain
  std::function<std::string()> phase;    ///< short description of the present activity
  std::function<bool()> waits_for_user;  ///< true: only a command of the user lets the run continue
  std::function<bool()> is_complete;     ///< true: only the end of the run is left
};

}  // namespace observe
