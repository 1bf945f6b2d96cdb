#pragma once
// A run that is watched while it goes on: what a program shows of itself, and what its user may do.
#include <any>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "simulator/machine/machine.hpp"

namespace observe {

/// What a program shows. Functions are called between two events and cost no simulated time.
struct View {
  struct Picture {
    int width = 0, height = 0;
    std::function<const std::vector<std::uint8_t>*()> rgb8;  ///< as the display shows it now
  };
  /// A number that changes: "rays", a queue's length.
  struct Gauge {
    std::string name, help;
    std::function<double()> value;
  };
  /// A number of one processor that changes: what its router or its cache holds.
  struct Reading {
    std::string name;
    double value = 0;
  };
  using Inspect = std::function<std::vector<Reading>(int processor)>;  ///< its id in the machine
  /// An order of the user's, a record of the program's list "order". It comes at the first tick of
  /// the user's clock after `after`, which is not before now; returns that as the record's at_s.
  /// Throws base::BadInput for what the experiment file would not be allowed to say.
  using TakeOrder = std::function<double(const std::any& record, machine::Seconds after)>;

  std::vector<int> network;  ///< ids of the network's processors in the machine; empty: the same
  std::optional<Picture> picture;
  /// The last picture as the sequential renderer makes it, rows from the top; empty if `goes_on`
  /// returns false meanwhile. May be called by another thread while the machine runs.
  std::function<std::vector<std::uint8_t>(const std::function<bool()>& goes_on)> sequential;
  std::vector<Gauge> gauges;
  std::vector<Inspect> inspections;      ///< each may know nothing of a processor
  TakeOrder take_order;                  ///< where the program has a user
  std::function<void()> close_orders;    ///< no more are taken: the user leaves after the file's
  std::function<std::string()> phase;    ///< what it is doing, in a few words
  std::function<bool()> waits_for_user;  ///< nothing will happen unless the user orders it
  std::function<bool()> is_complete;     ///< all is done but to end
};

/// Looks at a run, on any engine, and changes nothing of it.
struct Onlooker {
  virtual ~Onlooker() = default;
  /// The machine is there and is about to run; both live until `end`.
  virtual void begin(const machine::Machine& machine, const View& view) = 0;
  /// View::picture, if there is one, has been as it is until now, s, and is about to change.
  virtual void before_change(double now_s) = 0;
  /// The machine runs no more.
  virtual void end(double now_s) = 0;
};

/// Watches a run of a machine with Links::direct, and steers it.
struct Spectator : machine::Pace {
  /// The machine is there and is about to run; both live until `end`.
  virtual void begin(machine::Machine& machine, const View& view) = 0;
  /// It runs no more; `fault` says why, if it broke down.
  virtual void end(const std::string& fault) = 0;
};

}  // namespace observe
