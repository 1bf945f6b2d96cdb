#pragma once
// Faults of the simulated program, with place and time. The two other kinds of error, bad input and
// broken invariants, are in base/errors.hpp.
#include <fmt/format.h>

#include <stdexcept>
#include <string>

#include "base/errors.hpp"
#include "simulator/machine/units.hpp"

namespace machine {

/// A failure of the simulated program in `who`, a process or processor, at simulated time `when`.
struct Fault : std::runtime_error {
  Fault(std::string who, Seconds when, const std::string& what)
      : std::runtime_error(base::show_zeros(what)), who(std::move(who)), when(when) {}
  std::string who;
  Seconds when;
};

struct Deadlock : Fault {
  using Fault::Fault;
};

struct OutOfMemory : Fault {
  using Fault::Fault;
};

/// A request that no transputer can fulfil, such as two writers on a channel.
struct Misuse : Fault {
  using Fault::Fault;
};

}  // namespace machine
