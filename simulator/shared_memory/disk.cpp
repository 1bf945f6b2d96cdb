#include "simulator/shared_memory/disk.hpp"

#include "simulator/machine/processor.hpp"

namespace shared_memory {

namespace {

struct DiskWait : machine::Wait {
  std::string describe() const override { return "the disk"; }
};

}  // namespace

machine::Seconds Disk::time(std::uint64_t bytes) const {
  return seek_ + machine::Seconds{static_cast<double>(bytes) / rate_};
}

void Disk::read(std::uint64_t bytes) {
  auto& self = machine::this_process();
  ++reads_;
  self.sync();
  self.processor().wake_at(self.now() + time(bytes), self, self.waits() + 1);
  DiskWait wait;
  self.block(wait);
}

}  // namespace shared_memory
