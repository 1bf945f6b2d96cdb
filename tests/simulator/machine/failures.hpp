// Runs of machines that must fail.
#pragma once

#include <gtest/gtest.h>

#include "base/errors.hpp"
#include "simulator/machine/faults.hpp"
#include "tests/support/lab.hpp"

namespace occam {

// Runs a machine and returns its failure as text. The first line has the exception's type and, for
// a fault, its place and cycle. The other lines are the exception's message.
inline std::string failure_of(const std::function<void(Lab&)>& body) {
  return isolated([&]() -> std::string {
    Lab lab;
    auto fault = [&](const char* type, const machine::Fault& e) {
      const double cycle = e.when.value * lab.machine.model().cpu.clock.value;
      return fmt::format("{} of {} at {}\n{}", type, e.who, cycle, e.what());
    };
    try {
      body(lab);
      lab.machine.run();
    } catch (const machine::Deadlock& e) {
      return fault("Deadlock", e);
    } catch (const machine::OutOfMemory& e) {
      return fault("OutOfMemory", e);
    } catch (const machine::Misuse& e) {
      return fault("Misuse", e);
    } catch (const base::InvariantBroken& e) {
      return fmt::format("base::InvariantBroken\n{}", e.what());
    } catch (const std::runtime_error& e) {
      return fmt::format("runtime_error\n{}", e.what());
    }
    return "nothing\n";
  });
}

inline void expect_failure(const std::string& first_line, const std::vector<std::string>& parts,
                           const std::function<void(Lab&)>& body) {
  const std::string failure = failure_of(body);
  const auto end = failure.find('\n');
  EXPECT_EQ(failure.substr(0, end), first_line);
  for (const auto& part : parts)
    EXPECT_NE(failure.find(part, end), std::string::npos)
        << "no \"" << part << "\" in: " << failure;
}

}  // namespace occam
