#pragma once
// Increasing realism: the rays that matter now and their order (thesis, 4.3.2, 4.3.4), and the
// three stores of the ray database: shadow feelers (BDIss, unordered), the reflected and
// transmitted rays that matter now (BDIrt, a priority heap), and the rest (BDNI).
#include <array>
#include <optional>
#include <vector>

#include "simulator/farm/rays/cells.hpp"

namespace farm {

/// What the keys of a ray's priority weigh, at least 0 (thesis, 4.3.4: the user's choice). All 0:
/// they are compared one after the other.
struct Weights {
  double influence = 0;  ///< of the largest of its influence factors
  double level = 0;      ///< of 1 over its level
  double cell = 0;       ///< of log2 of its cell's size, over that of the largest
  bool operator==(const Weights&) const = default;
};

/// The user's parameters of increasing realism. A ray within all of them is "in interactive mode"
/// (RMI); one beyond any waits for the non-interactive phase (RMNI).
struct Limits {
  double min_influence = 0.0;    ///< influence factor, at least
  int depth_reflected = 1000;    ///< level, at most, of rays with only reflections before them
  int depth_transmitted = 1000;  ///< level, at most, of transmitted rays and their descendants
  int min_cell = 1;              ///< pixels, size of the image cell, at least
  renderer::Area area;           ///< pixels of interest, of which a ray's cell has one; 0 x 0: all
  std::optional<Weights> weights;  ///< of the keys; none: the farm's
  bool operator==(const Limits&) const = default;
};

bool is_interactive(const renderer::Ray& ray, const Limits& limits, const Cells& cells);

/// Whether `a` goes before `b`: the earlier of its pixel's samples; then larger influence factor,
/// then lower level, then larger cell, as long as the keys have no weights; then by the order of
/// cells. An urgent ray's cell counts as
/// four times as large.
bool goes_before(const renderer::Ray& a, const renderer::Ray& b, const Cells& cells,
                 const Weights& weights = {});

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
  /// `weights` where the limits have none.
  RayStores(Cells cells, Limits limits, Weights weights = {})
      : cells_(cells), weights_(weights), limits_(limits) {}

  void add(const renderer::Ray& ray, DatabaseWork& work);
  /// A feeler if there is one, else the first ray of the heap; else, if `any`, one beyond the
  /// limits; else none.
  std::optional<renderer::Ray> take(bool any, DatabaseWork& work);
  /// Classifies all rays again, exchanges them between the stores as necessary, rebuilds the heap.
  /// Those that come within the limits belong to `order` from now on.
  void set_limits(const Limits& limits, DatabaseWork& work, std::uint8_t order = 0);

  std::size_t size() const { return feelers_.size() + heap_.size() + later_.size(); }
  /// Rays, by store.
  struct Lengths {
    std::size_t feelers = 0, heap = 0, later = 0;
  };
  Lengths lengths() const { return {feelers_.size(), heap_.size(), later_.size()}; }
  const Lengths& peaks() const { return peaks_; }  ///< the most that each has held at once

 private:
  auto before() const {
    return [this](const renderer::Ray& a, const renderer::Ray& b) {
      return goes_before(a, b, cells_, limits_.weights.value_or(weights_));
    };
  }
  void note_peaks();

  Cells cells_;
  Weights weights_;
  Limits limits_;
  std::vector<renderer::Ray> feelers_, heap_, later_;
  Lengths peaks_;
};

}  // namespace farm
