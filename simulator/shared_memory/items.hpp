#pragma once
// Data items that any processor may need: objects, surfaces, light sources (5.1.2.3).
#include <cstdint>
#include <vector>

namespace shared_memory {

/// Two-level address: a class, and a number within the class.
struct Item {
  int of_class = 0;
  int number = 0;
};

/// All items with their sizes. Places number all items, class after class.
class Catalogue {
 public:
  /// `bytes`: the size of each item, by class and number. Throws base::BadInput if there are none.
  explicit Catalogue(std::vector<std::vector<std::uint64_t>> bytes);

  std::size_t place(Item item) const;  ///< throws base::InvariantBroken if there is no such item
  const std::vector<std::uint64_t>& bytes() const {
    return bytes_;
  }                               ///< each item's size, by place
  std::uint64_t largest() const;  ///< bytes of the largest item

 private:
  std::vector<std::size_t> first_;  // place of each class's first item, and the end
  std::vector<std::uint64_t> bytes_;
};

/// One class of items of one size.
Catalogue make_catalogue(int items, std::uint64_t bytes);

}  // namespace shared_memory
