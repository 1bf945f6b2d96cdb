// The LRU cache, compared with a list that is searched.
#include "simulator/shared_memory/lru_cache.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "base/errors.hpp"
#include "simulator/shared_memory/items.hpp"

namespace shared_memory {
namespace {

struct Naive {
  std::vector<std::uint64_t> bytes;
  std::uint64_t capacity;
  std::vector<std::size_t> order;  // items in the cache, the most recently used first

  bool holds(std::size_t record) const { return std::ranges::count(order, record) > 0; }
  std::uint64_t used() const {
    std::uint64_t sum = 0;
    for (const auto record : order) sum += bytes[record];
    return sum;
  }
  void insert(std::size_t record) {
    std::erase(order, record);
    while (used() + bytes[record] > capacity) order.pop_back();
    order.insert(order.begin(), record);
  }
};

TEST(LruCache, HoldsWhatANaiveOneHolds) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    const auto below = [&](std::uint64_t n) { return random() % n; };
    std::vector<std::uint64_t> bytes(1 + below(40));
    for (auto& b : bytes) b = below(20);
    const auto capacity = *std::ranges::max_element(bytes) + below(200);
    LruCache cache(bytes, capacity, "data.cache");
    Naive naive{bytes, capacity, {}};
    for (int step = 0; step < 300; ++step) {
      const auto record = below(bytes.size());
      ASSERT_EQ(cache.holds(record), naive.holds(record));
      const auto before = naive.order.size();
      const bool held = naive.holds(record);
      if (held && below(2) == 0) {
        cache.touch(record);
        naive.insert(record);
      } else {
        const int dropped = cache.insert(record);
        naive.insert(record);
        EXPECT_EQ(before + (held ? 0 : 1) - naive.order.size(), static_cast<std::size_t>(dropped));
      }
      ASSERT_EQ(cache.order(), naive.order);
      ASSERT_EQ(cache.used(), naive.used());
      ASSERT_LE(cache.used(), capacity);
    }
  }
}

TEST(LruCache, ARecordThatDoesNotFitIsBadInput) {
  EXPECT_NO_THROW(LruCache({3, 8}, 8, "data.cache"));
  try {
    LruCache({3, 8}, 7, "data.cache");
    FAIL();
  } catch (const base::BadInput& error) {
    for (const char* part : {"data.cache", "found a cache of 7 bytes", "expected at least 8"})
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  }
}

TEST(Catalogue, CountsPlacesClassAfterClass) {
  const Catalogue catalogue({{10, 20}, {}, {30}});
  EXPECT_EQ(catalogue.bytes(), (std::vector<std::uint64_t>{10, 20, 30}));
  EXPECT_EQ(catalogue.place({0, 1}), 1u);
  EXPECT_EQ(catalogue.place({2, 0}), 2u);
  EXPECT_EQ(catalogue.largest(), 30u);
  for (const Item missing : {Item{0, 2}, Item{1, 0}, Item{3, 0}, Item{-1, 0}, Item{0, -1}})
    EXPECT_THROW(catalogue.place(missing), base::InvariantBroken);
  EXPECT_THROW(make_catalogue(0, 8), base::BadInput);
}

}  // namespace
}  // namespace shared_memory
