#pragma once
// Increasing realism: selection and order of rays (thesis, 4.3.2, 4.3.4). The ray database has
// three stores: shadow feelers (BDIss, unordered), reflected and transmitted rays within the limits
// (BDIrt, a priority queue), and all other rays (BDNI).
#include <array>
#include <optional>
#include <vector>

#include "simulator/farm/rays/cells.hpp"

namespace farm {

/// Weights of the keys in a ray's priority, set by the user, at least 0 (thesis, 4.3.4). If all are
/// 0, keys are compared lexicographically.
struct Weights {
  double influence = 0;  ///< weight of the ray's largest influence factor
  double level = 0;      ///< weight of 1 / level
  double cell = 0;       ///< weight of log2(cell size) / log2(largest cell size)
  bool operator==(const Weights&) const = default;
};

/// The user's parameters of increasing realism. A ray within all limits is "in interactive mode"
/// (RMI). Any other ray waits for the non-interactive phase (RMNI).
struct Limits {
  double min_influence = 0.0;      ///< minimum influence factor
  int depth_reflected = 1000;      ///< maximum level of rays that follow only reflections
  int depth_transmitted = 1000;    ///< maximum level of transmitted rays and their descendants
  int min_cell = 1;                ///< minimum size of image cells in pixels
  renderer::Area area;             ///< pixels that a ray's cell must overlap; 0 x 0 for all
  std::optional<Weights> weights;  ///< if absent, those of the farm
  bool operator==(const Limits&) const = default;
};

bool is_interactive(const renderer::Ray& ray, const Limits& limits, const Cells& cells);

/// True if `a` precedes `b`. Earlier samples of a pixel come first. Without weights, the next keys
/// are: larger influence factor, lower level, larger cell. With weights, a weighted sum
/// replaces these keys. Ties are resolved by the order of cells. The cell of an urgent ray counts
/// as four times as large.
bool goes_before(const renderer::Ray& a, const renderer::Ray& b, const Cells& cells,
                 const Weights& weights = {});

/// Counts of the database's operations, with the names used in model files.
struct DatabaseWork {
  std::uint64_t heap_step = 0;       ///< exchanges of two rays in the heap
  std::uint64_t record_stored = 0;   ///< rays moved into or out of a store
  std::uint64_t ray_classified = 0;  ///< rays compared with the limits
  static constexpr std::array<std::string_view, 3> NAMES = {"heap_step", "record_stored",
                                                            "ray_classified"};
  std::array<std::uint64_t, 3> counts() const { return {heap_step, record_stored, ray_classified}; }
};

class RayStores {
 public:
  /// `weights` apply if the limits have none.
  RayStores(Cells cells, Limits limits, Weights weights = {})
      : cells_(cells), weights_(weights), limits_(limits) {}

  void add(const renderer::Ray& ray, DatabaseWork& work);
  /// Takes a feeler if there is one, otherwise the first ray of the heap. If both are empty and
  /// `any` is true, takes a ray beyond the limits. Returns none if there is no such ray.
  std::optional<renderer::Ray> take(bool any, DatabaseWork& work);
  /// Reclassifies all rays, moves them between stores and rebuilds the heap. Rays that the new
  /// limits admit are assigned to the user's order number `order`.
  void set_limits(const Limits& limits, DatabaseWork& work, std::uint8_t order = 0);

  std::size_t size() const { return feelers_.size() + heap_.size() + later_.size(); }
  /// Number of rays in each store.
  struct Lengths {
    std::size_t feelers = 0, heap = 0, later = 0;
  };
  Lengths lengths() const { return {feelers_.size(), heap_.size(), later_.size()}; }
  const Lengths& peaks() const { return peaks_; }  ///< maximum since the start, by store

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
