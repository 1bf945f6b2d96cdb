#include "simulator/shared_memory/items.hpp"

#include <algorithm>

#include "base/errors.hpp"

namespace shared_memory {

Catalogue::Catalogue(std::vector<std::vector<std::uint64_t>> bytes) {
  for (const auto& of_class : bytes) {
    first_.push_back(bytes_.size());
    bytes_.insert(bytes_.end(), of_class.begin(), of_class.end());
  }
  first_.push_back(bytes_.size());
  if (bytes_.empty()) base::refuse("data.items", "found none, expected at least one item");
}

std::size_t Catalogue::place(Item item) const {
  const auto c = static_cast<std::size_t>(item.of_class);
  const auto n = static_cast<std::size_t>(item.number);
  if (item.of_class < 0 || item.number < 0 || c + 1 >= first_.size() ||
      n >= first_[c + 1] - first_[c])
    throw base::InvariantBroken(fmt::format("found item {} of class {}, expected an existing one",
                                            item.number, item.of_class));
  return first_[c] + n;
}

std::uint64_t Catalogue::largest() const { return *std::ranges::max_element(bytes_); }

Catalogue make_catalogue(int items, std::uint64_t bytes) {
  return Catalogue({std::vector(static_cast<std::size_t>(std::max(items, 0)), bytes)});
}

}  // namespace shared_memory
