#pragma once
// Data items that any processor may use: objects, surfaces, light sources (thesis, 5.1.2.3).
#include <cstdint>
#include <vector>

namespace shared_memory {

/// Address of an item on two levels: a class of items, and a number within the class.
struct Item {
  int of_class = 0;
  int number = 0;
};

/// All items with their sizes. The place of an item is its index, from 0, in the sequence of all
/// items, one class after the other.
class Catalogue {
 public:
  /// `bytes` holds the size in bytes of each item, by class and number. Throws base::BadInput if
  /// there are no items.
  explicit Catalogue(std::vector<std::vector<std::uint64_t>> bytes);

  std::size_t place(Item item) const;  ///< throws base::InvariantBroken for an unknown item
  const std::vector<std::uint64_t>& bytes() const {
    return bytes_;
  }                               ///< sizes of the items, by place
  std::uint64_t largest() const;  ///< size of the largest item in bytes

 private:
  // Place of the first item of each class. The last element is the number of all items.
  std::vector<std::size_t> first_;
  std::vector<std::uint64_t> bytes_;
};

/// Makes a catalogue of one class, with `items` items of `bytes` bytes each.
Catalogue make_catalogue(int items, std::uint64_t bytes);

}  // namespace shared_memory
