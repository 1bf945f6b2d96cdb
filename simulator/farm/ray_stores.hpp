#pragma once
// The three stores of the ray database (thesis, 4.3.4): shadow feelers (BDIss, unordered), the
// reflected and transmitted rays that matter now (BDIrt, a priority heap), and the rest (BDNI).
#include <array>
#include <optional>
#include <vector>

#include "simulator/farm/priority.hpp"

namespace farm {

/// The database's operations, with the names that model files use.
struct DatabaseWork {
  std::uint64_t heap_step = 0;       ///< an exchange of two rays in the heap
  std::uint64_t record_stored = 0;   ///< a ray moved into or out of a store
  std::uint64_t ray_classified = 0;  ///< compared with the limits
  static constexpr std::array<std::string_view, 3> NAMES = {"heap_step", "record_stored",
                                                            "ray_classified"};
  std::array<std::uint64_t, 3> counts() const { return {heap_step, record_stored, ray_classified}; }
};

class RayStores {
 public:
  RayStores(Cells cells, Limits limits) : cells_(cells), limits_(limits) {}

  void add(const renderer::Ray& ray, DatabaseWork& work);
  /// A feeler if there is one, else the first ray of the heap; else, if `any`, one beyond the
  /// limits; else none.
  std::optional<renderer::Ray> take(bool any, DatabaseWork& work);
  /// Classifies all rays again, exchanges them between the stores as necessary, rebuilds the heap.
  void set_limits(const Limits& limits, DatabaseWork& work);

  std::size_t size() const { return feelers_.size() + heap_.size() + later_.size(); }
  /// The most rays that each store has held at once.
  struct Peaks {
    std::size_t feelers = 0, heap = 0, later = 0;
  };
  const Peaks& peaks() const { return peaks_; }

 private:
  void sift_up(std::size_t i, DatabaseWork& work);
  void sift_down(std::size_t i, DatabaseWork& work);
  bool before(std::size_t a, std::size_t b) const {
    return goes_before(heap_[a], heap_[b], cells_);
  }
  void note_peaks();

  Cells cells_;
  Limits limits_;
  std::vector<renderer::Ray> feelers_, heap_, later_;
  Peaks peaks_;
};

}  // namespace farm
