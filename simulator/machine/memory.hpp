#pragma once
// The memory of one simulated processor: what its program has allocated, and its limit.
#include <algorithm>
#include <cstdint>
#include <string>

#include "simulator/machine/faults.hpp"

namespace machine {

class Memory {
 public:
  /// `size` in bytes; `owner` is the processor's name, for the fault.
  Memory(std::string owner, std::uint64_t size) : owner_(std::move(owner)), size_(size) {}

  /// Throws OutOfMemory, with the bytes asked for and available, if they do not fit.
  void allocate(std::uint64_t bytes, const std::string& what, Seconds when) {
    if (bytes > left())
      throw OutOfMemory(
          owner_, when,
          fmt::format(
              "{} is out of memory at {:.6f} s: {} asked for {} bytes, {} of {} are available",
              owner_, when.value, what, bytes, left(), size_));
    used_ += bytes;
    peak_ = std::max(peak_, used_);
  }
  void release(std::uint64_t bytes) { used_ -= bytes; }

  std::uint64_t size() const { return size_; }
  std::uint64_t used() const { return used_; }
  std::uint64_t left() const { return size_ - used_; }
  std::uint64_t peak() const { return peak_; }

 private:
  std::string owner_;
  std::uint64_t size_, used_ = 0, peak_ = 0;
};

}  // namespace machine
