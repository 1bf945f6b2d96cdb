#pragma once
// An array of port numbers, one per processor, with two bits each.

#include <cstdint>
#include <vector>

#include "topologies/graph/topology.hpp"

namespace topologies {

class PackedPorts {
 public:
  PackedPorts() = default;
  /// Sets the port of every processor to 0.
  explicit PackedPorts(int processors) : bytes_((processors + IN_BYTE - 1) / IN_BYTE) {}

  bool empty() const { return bytes_.empty(); }
  int get(int processor) const {
    return bytes_[processor / IN_BYTE] >> shift_of(processor) & (PORTS - 1);
  }
  void set(int processor, int port) {
    auto& byte = bytes_[processor / IN_BYTE];
    const unsigned shift = shift_of(processor);
    byte = static_cast<std::uint8_t>((byte & ~((PORTS - 1U) << shift)) | static_cast<unsigned>(port)
                                                                             << shift);
  }

 private:
  static constexpr int IN_BYTE = 4;
  static_assert(PORTS == 4, "a port fits two bits");
  static unsigned shift_of(int processor) { return 2U * (processor % IN_BYTE); }

  std::vector<std::uint8_t> bytes_;
};

}  // namespace topologies
