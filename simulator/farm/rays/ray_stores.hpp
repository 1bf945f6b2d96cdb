#pragma once
// Selection and order of rays for increasing realism (thesis, 4.3.2, 4.3.4). The ray database has
// three stores: shadow feelers, which are rays to the lights (BDIss, unordered); reflected and
// transmitted rays within the user's limits (BDIrt, a priority queue); and all other rays (BDNI).
#include <array>
#include <optional>
#include <vector>

#include "simulator/farm/rays/cells.hpp"

namespace farm {

/// Weights of three criteria in a ray's priority, set by the user, each at least 0 (thesis, 4.3.4).
/// If all are 0, the criteria are compared one after another instead of being added.
struct Weights {
  double influence = 0;  ///< weight of the ray's largest influence factor
  double level = 0;      ///< weight of 1 / level, where primary rays have level 1
  double cell = 0;       ///< weight of log2(cell size) / log2(largest cell size)
  bool operator==(const Weights&) const = default;
};

/// Limits set by the user. A ray within all limits is "in interactive mode" (RMI) and is traced
/// first. Any other ray waits for the non-interactive phase (RMNI).
struct Limits {
  double min_influence = 0.0;  ///< minimum influence factor
  /// Maximum level in the shading tree of rays that follow only reflections.
  int depth_reflected = 1000;
  int depth_transmitted = 1000;    ///< maximum level of transmitted rays and of their descendants
  int min_cell = 1;                ///< minimum side of image cells in pixels
  renderer::Area area;             ///< pixels that a ray's cell must overlap; 0 x 0 for all
  std::optional<Weights> weights;  ///< if absent, the weights in the farm's parameters apply
  bool operator==(const Limits&) const = default;
};

bool is_interactive(const renderer::Ray& ray, const Limits& limits, const Cells& cells);

/// True if ray `a` must be traced before ray `b`. Earlier samples of a pixel come first. Then,
/// without weights, the larger influence factor decides, then the lower level, then the larger
/// cell; with weights, the larger weighted sum of these criteria decides. Ties are resolved by the
/// order of cells. The cell of an urgent ray counts as four times as large.
bool goes_before(const renderer::Ray& a, const renderer::Ray& b, const Cells& cells,
                 const Weights& weights = {});

/// Numbers of operations of the database, with the names used in model files.
struct DatabaseWork {
  std::uint64_t heap_step = 0;       ///< exchanges of two rays in the heap
  std::uint64_t record_stored = 0;   ///< rays moved into or out of a store
  std::uint64_t ray_classified = 0;  ///< comparisons of a ray with the limits
  static constexpr std::array<std::string_view, 3> NAMES = {"heap_step", "record_stored",
                                                            "ray_classified"};
  std::array<std::uint64_t, 3> counts() const { return {heap_step, record_stored, ray_classified}; }
};

class RayStores {
 public:
  /// `weights` apply whenever the limits have no weights.
  RayStores(Cells cells, Limits limits, Weights weights = {})
      : cells_(cells), weights_(weights), limits_(limits) {}

  void add(const renderer::Ray& ray, DatabaseWork& work);
  /// Removes and returns a shadow feeler if there is one, otherwise the first ray of the priority
  /// queue. If both stores are empty and `any` is true, takes a ray beyond the limits. Returns
  /// nothing if no such ray is stored.
  std::optional<renderer::Ray> take(bool any, DatabaseWork& work);
  /// Compares all rays except shadow feelers with the new limits, moves them between stores and
  /// rebuilds the heap. Marks each ray that the new limits admit with `order`, the number of the
  /// user's order.
  void set_limits(const Limits& limits, DatabaseWork& work, std::uint8_t order = 0);

  std::size_t size() const { return feelers_.size() + heap_.size() + later_.size(); }
  /// Number of rays in each store: shadow feelers, the priority queue, and rays beyond the limits.
  struct Lengths {
    std::size_t feelers = 0, heap = 0, later = 0;
  };
  Lengths lengths() const { return {feelers_.size(), heap_.size(), later_.size()}; }
  const Lengths& peaks() const { return peaks_; }  ///< maximum length of each store since the start

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
