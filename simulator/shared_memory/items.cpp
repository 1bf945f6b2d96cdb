#include "simulator/shared_memory/items.hpp"

#include <algorithm>
#include <numeric>

#include "base/errors.hpp"

namespace shared_memory {

Catalogue::Catalogue(std::vector<std::vector<std::uint64_t>> bytes) {
  for (std::size_t c = 0; c < bytes.size(); ++c) {
    first_.push_back(items_.size());
    for (std::size_t n = 0; n < bytes[c].size(); ++n) {
      items_.push_back({static_cast<int>(c), static_cast<int>(n)});
      bytes_.push_back(bytes[c][n]);
    }
  }
  first_.push_back(items_.size());
  if (items_.empty()) throw base::BadInput("data.items: found none, expected at least one item");
}

std::size_t Catalogue::place(Item item) const {
  const auto c = static_cast<std::size_t>(item.of_class);
  const auto n = static_cast<std::size_t>(item.number);
  if (item.of_class < 0 || item.number < 0 || c + 1 >= first_.size() ||
      n >= first_[c + 1] - first_[c])
    throw base::InvariantBroken(fmt::format("no item {} of class {}", item.number, item.of_class));
  return first_[c] + n;
}

std::uint64_t Catalogue::largest() const { return *std::ranges::max_element(bytes_); }

std::uint64_t Catalogue::total() const {
  return std::accumulate(bytes_.begin(), bytes_.end(), std::uint64_t{0});
}

Catalogue make_catalogue(int items, std::uint64_t bytes) {
  return Catalogue({std::vector(static_cast<std::size_t>(std::max(items, 0)), bytes)});
}

}  // namespace shared_memory
