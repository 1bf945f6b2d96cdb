#include "simulator/machine/memory.hpp"

#include <algorithm>

#include "simulator/machine/faults.hpp"

namespace machine {

void Memory::allocate(std::uint64_t bytes, const std::string& what, Seconds when) {
  if (bytes > size_ - used_)
    throw OutOfMemory(
        owner_, when,
        fmt::format(
            "{} is out of memory at {:.6f} s: {} asked for {} bytes, {} of {} are available",
            owner_, when.value, what, bytes, size_ - used_, size_));
  used_ += bytes;
  peak_ = std::max(peak_, used_);
}

}  // namespace machine
