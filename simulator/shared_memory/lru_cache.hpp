#pragma once
// A cache of fixed size that evicts the least recently used record (thesis, 5.1.2.2). Records are
// numbered from 0. A list orders the records in the cache by their last use, the latest first.
#include <cstdint>
#include <string>
#include <vector>

namespace shared_memory {

class LruCache {
 public:
  /// `bytes[r]` is the size of record r, and `capacity` the size of the cache, both in bytes. If a
  /// record is larger than the cache, throws base::BadInput that names `key`.
  LruCache(std::vector<std::uint64_t> bytes, std::uint64_t capacity, const std::string& key);

  bool holds(std::size_t record) const { return next_.at(record) != NOT_HELD; }
  /// Moves a record, which must be in the cache, to the top of the list.
  void touch(std::size_t record);
  /// Inserts a record at the top of the list, and evicts records from the end of the list to make
  /// room. Returns the number of evicted records. A record that is already in the cache is moved to
  /// the top.
  int insert(std::size_t record);

  std::uint64_t capacity() const { return capacity_; }  // in bytes
  std::uint64_t used() const { return used_; }
  std::vector<std::size_t> order() const;  ///< records by last use, the latest first

 private:
  static constexpr std::size_t NOT_HELD = ~std::size_t{0};
  void unlink(std::size_t record);
  void put_on_top(std::size_t record);

  std::vector<std::uint64_t> bytes_;
  std::uint64_t capacity_, used_ = 0;
  // Doubly linked list: the next and the previous record of each record. The additional last entry
  // is the sentinel before the first and after the last record.
  std::vector<std::size_t> next_, previous_;
};

}  // namespace shared_memory
