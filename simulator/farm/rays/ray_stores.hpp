#pragma once
// Increasing realism: selection and order of rays (thesis, 4.3.2, 4.3.4). The ray database has
// three stores: shadow feelers (BDIss, unordered), reflected and transmitted rays within the limits
// (BDIrt, a priority heap), and all others (BDNI).
#include <array>
#include <optional>
#include <vector>

#include "simulator/farm/rays/cells.hpp"

namespace farm {

/// Weights of the keys of a ray's priority, from 0 (thesis, 4.3.4: the user's choice). All 0: keys
/// are compared one after another.
struct Weights {
  double influence = 0;  ///< of the ray's largest influence factor
  double level = 0;      ///< of 1 / level
  double cell = 0;       ///< of log2 of the cell's size, divided by log2 of the largest
  bool operator==(const Weights&) const = default;
};

/// The user's parameters of increasing realism. A ray within all of them is "in interactive mode"
/// (RMI); any other waits for the non-interactive phase (RMNI).
struct Limits {
  double min_influence = 0.0;    ///< smallest influence factor
  int depth_reflected = 1000;    ///< highest level of rays with only reflections before them
  int depth_transmitted = 1000;  ///< highest level of transmitted rays and their descendants
  int min_cell = 1;              ///< smallest image cell, pixels
  renderer::Area area;           ///< pixels of interest; a ray's cell must overlap them; 0 x 0: all
  std::optional<Weights> weights;  ///< none: the farm's
  bool operator==(const Limits&) const = default;
};

bool is_interactive(const renderer::Ray& ray, const Limits& limits, const Cells& cells);

/// True if `a` goes before `b`. An earlier sample of its pixel goes first. Without weights, keys
/// follow: larger influence factor, lower level, larger cell. Weights replace the keys by a
/// weighted sum. The order of cells breaks ties. An urgent ray's cell counts as four times as
/// large.
bool goes_before(const renderer::Ray& a, const renderer::Ray& b, const Cells& cells,
                 const Weights& weights = {});

/// Operations of the database, named as in model files.
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
  /// `weights` apply if the limits have none.
  RayStores(Cells cells, Limits limits, Weights weights = {})
      : cells_(cells), weights_(weights), limits_(limits) {}

  void add(const renderer::Ray& ray, DatabaseWork& work);
  /// Takes a feeler, else the first ray of the heap, else, if `any`, a ray beyond the limits. None
  /// if there is no such ray.
  std::optional<renderer::Ray> take(bool any, DatabaseWork& work);
  /// Reclassifies all rays, moves them between the stores and rebuilds the heap. Rays that come
  /// within the limits are assigned to `order`.
  void set_limits(const Limits& limits, DatabaseWork& work, std::uint8_t order = 0);

  std::size_t size() const { return feelers_.size() + heap_.size() + later_.size(); }
  /// Rays, by store.
  struct Lengths {
    std::size_t feelers = 0, heap = 0, later = 0;
  };
  Lengths lengths() const { return {feelers_.size(), heap_.size(), later_.size()}; }
  const Lengths& peaks() const { return peaks_; }  ///< most rays held at once, by store

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
