#pragma once
// The host's disk, as the coordinator sees it: it asks for a record over the host link and waits.
#include <cstdint>

#include "simulator/machine/model.hpp"
#include "simulator/machine/units.hpp"

namespace shared_memory {

class Disk {
 public:
  explicit Disk(const machine::Model& model) : seek_{model.disk.seek}, rate_{model.disk.rate} {}
  machine::Seconds time(std::uint64_t bytes) const;
  // Blocks the process until the record is there.
  void read(std::uint64_t bytes);
  std::uint64_t reads() const { return reads_; }

 private:
  machine::Seconds seek_;
  double rate_;
  std::uint64_t reads_ = 0;
};

}  // namespace shared_memory
