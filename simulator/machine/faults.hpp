#pragma once
// What can go wrong: three kinds, never mixed. Bad input is rejected before anything runs; a fault
// is the simulated program's own, with who and when; a broken invariant is a defect of tlab.
#include <fmt/format.h>

#include <stdexcept>
#include <string>

#include "simulator/machine/units.hpp"

namespace machine {

// Bad input: names the file or key, what was found and what was expected.
struct InvalidInput : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// The simulated program failed: `who` (a process or processor) at simulated time `when`.
struct Fault : std::runtime_error {
  Fault(std::string who, Seconds when, const std::string& what)
      : std::runtime_error(what), who(std::move(who)), when(when) {}
  std::string who;
  Seconds when;
};

struct Deadlock : Fault {
  using Fault::Fault;
};

struct OutOfMemory : Fault {
  using Fault::Fault;
};

// A broken invariant, always checked: prints both values.
struct InvariantBroken : std::logic_error {
  using std::logic_error::logic_error;
};

template <class A, class B>
void check_equal(const char* what, const A& found, const B& expected) {
  if (!(found == expected))
    throw InvariantBroken(fmt::format("{}: found {}, expected {}", what, found, expected));
}

}  // namespace machine
