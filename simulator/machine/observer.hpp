#pragma once
// An observer of a machine that runs: it is told what processors and links did, once that is over.
#include <cstdint>
#include <string>

#include "simulator/machine/units.hpp"

namespace machine {

class Processor;
class LinkDirection;

struct Observer {
  enum class Doing : std::uint8_t { high, low, switching };

  virtual ~Observer() = default;
  /// Names a process; processes of one name on one processor share an id, dense from 0.
  virtual void name_process(const Processor& on, std::uint32_t id, const std::string& name) = 0;
  virtual void ran(const Processor& on, std::uint32_t id, Doing doing, Seconds from,
                   Seconds to) = 0;
  virtual void moved(const LinkDirection& link, const std::string& channel, std::uint64_t bytes,
                     Seconds from, Seconds to) = 0;
};

}  // namespace machine
