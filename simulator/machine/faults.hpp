#pragma once
// Faults of the simulated program, with their place and simulated time. The other two kinds of
// error, bad input and broken invariants, are in base/errors.hpp.
#include <fmt/format.h>

#include <stdexcept>
#include <string>

#include "base/errors.hpp"
#include "simulator/machine/units.hpp"

namespace machine {

/// A fault in the process or processor named `who`, at the simulated date `when`.
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

/// An action that is impossible on a transputer, such as two writers on one channel.
struct Misuse : Fault {
  using Fault::Fault;
};

}  // namespace machine
