#pragma once
// Data items used by any processor: objects, surfaces, light sources (5.1.2.3).
#include <cstdint>
#include <vector>

namespace shared_memory {

/// A two-level address: a class, and a number within the class.
struct Item {
  int of_class = 0;
  int number = 0;
};

/// All items with their sizes. A place is an item's index in the sequence of all items, class after
/// class.
class Catalogue {
 public:
  /// `bytes` holds the size of each item, by class and number. Throws base::BadInput if there are
  /// no items.
  explicit Catalogue(std::vector<std::vector<std::uint64_t>> bytes);

  std::size_t place(Item item) const;  ///< throws base::InvariantBroken for an unknown item
  const std::vector<std::uint64_t>& bytes() const {
    return bytes_;
  }                               ///< sizes of the items, by place
  std::uint64_t largest() const;  ///< size of the largest item in bytes

 private:
  std::vector<std::size_t> first_;  // place of each class's first item, then the total
  std::vector<std::uint64_t> bytes_;
};

/// Makes a catalogue with a single class of items of equal size.
Catalogue make_catalogue(int items, std::uint64_t bytes);

}  // namespace shared_memory
