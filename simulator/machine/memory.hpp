#pragma once
// The memory of one simulated processor: what its program has allocated, and its limit.
#include <cstdint>
#include <string>

#include "simulator/machine/units.hpp"

namespace machine {

class Memory {
 public:
  // `size` in bytes; `owner` is the processor's name, for the fault.
  Memory(std::string owner, std::uint64_t size) : owner_(std::move(owner)), size_(size) {}

  // Throws OutOfMemory, with the bytes asked for and available, if they do not fit.
  void allocate(std::uint64_t bytes, const std::string& what, Seconds when);
  void release(std::uint64_t bytes) { used_ -= bytes; }

  std::uint64_t size() const { return size_; }
  std::uint64_t used() const { return used_; }
  std::uint64_t peak() const { return peak_; }

 private:
  std::string owner_;
  std::uint64_t size_, used_ = 0, peak_ = 0;
};

}  // namespace machine
