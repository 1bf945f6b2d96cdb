#include "simulator/shared_memory/lru_cache.hpp"

#include <algorithm>

#include "base/errors.hpp"

namespace shared_memory {

LruCache::LruCache(std::vector<std::uint64_t> bytes, std::uint64_t capacity, const std::string& key)
    : bytes_(std::move(bytes)),
      capacity_(capacity),
      next_(bytes_.size() + 1, NOT_HELD),
      previous_(next_) {
  next_.back() = previous_.back() = bytes_.size();
  const auto largest = bytes_.empty() ? 0 : *std::ranges::max_element(bytes_);
  if (largest > capacity)
    base::refuse(key, "found a cache of {} bytes, expected at least {} bytes, its largest record",
                 capacity, largest);
}

void LruCache::unlink(std::size_t record) {
  next_[previous_[record]] = next_[record];
  previous_[next_[record]] = previous_[record];
  next_[record] = previous_[record] = NOT_HELD;
}

void LruCache::put_on_top(std::size_t record) {
  const std::size_t ends = bytes_.size();
  next_[record] = next_[ends];
  previous_[record] = ends;
  previous_[next_[ends]] = record;
  next_[ends] = record;
}

void LruCache::touch(std::size_t record) {
  unlink(record);
  put_on_top(record);
}

int LruCache::insert(std::size_t record) {
  if (holds(record)) {
    touch(record);
    return 0;
  }
  int dropped = 0;
  for (; used_ + bytes_[record] > capacity_; ++dropped) {
    const std::size_t last = previous_.back();
    used_ -= bytes_[last];
    unlink(last);
  }
  used_ += bytes_[record];
  put_on_top(record);
  return dropped;
}

std::vector<std::size_t> LruCache::order() const {
  std::vector<std::size_t> records;
  for (std::size_t r = next_.back(); r != bytes_.size(); r = next_[r]) records.push_back(r);
  return records;
}

}  // namespace shared_memory
