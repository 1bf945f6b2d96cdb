#pragma once
// A cache of a set size that drops what has not been used for longest (5.1.2.2): an ordered list of
// what it holds, the most recent first. Records are known by numbers from 0 on.
#include <cstdint>
#include <string>
#include <vector>

namespace shared_memory {

class LruCache {
 public:
  /// `bytes[r]` is the size of record r. Throws base::BadInput, naming `key`, if some record does
  /// not fit.
  LruCache(std::vector<std::uint64_t> bytes, std::uint64_t capacity, const std::string& key);

  bool holds(std::size_t record) const { return next_.at(record) != NOT_HELD; }
  /// Moves a record that is held to the top of the list.
  void touch(std::size_t record);
  /// Puts a record at the top; the last ones make room. Returns how many were dropped. A record
  /// that is held already is touched.
  int insert(std::size_t record);

  std::uint64_t capacity() const { return capacity_; }  // bytes
  std::uint64_t used() const { return used_; }
  std::vector<std::size_t> order() const;  ///< most recent first

 private:
  static constexpr std::size_t NOT_HELD = ~std::size_t{0};
  void unlink(std::size_t record);
  void put_on_top(std::size_t record);

  std::vector<std::uint64_t> bytes_;
  std::uint64_t capacity_, used_ = 0;
  // The list, by record; the entry behind the last record is both its ends.
  std::vector<std::size_t> next_, previous_;
};

}  // namespace shared_memory
