#pragma once
// Increasing realism: the rays that matter now and their order (thesis, 4.3.2, 4.3.4), and the
// three stores of the ray database: shadow feelers (BDIss, unordered), the reflected and
// transmitted rays that matter now (BDIrt, a priority heap), and the rest (BDNI).
#include <array>
#include <optional>
#include <vector>

#include "renderer/trace/shade.hpp"

namespace farm {

/// The user's parameters of increasing realism. A ray within all of them is "in interactive mode"
/// (RMI); one beyond any waits for the non-interactive phase (RMNI).
struct Limits {
  double min_influence = 0.0;    ///< influence factor, at least
  int depth_reflected = 1000;    ///< level, at most, of rays with only reflections before them
  int depth_transmitted = 1000;  ///< level, at most, of transmitted rays and their descendants
  int min_cell = 1;              ///< pixels, size of the image cell, at least
  renderer::Area area;           ///< pixels of interest; 0 x 0: the whole image
  bool operator==(const Limits&) const = default;
};

/// Image cells: squares of `max_cell` pixels (a power of two) tile the image, and each cell is
/// divided into four smaller ones, down to single pixels. A sample lies at the upper-left corners
/// of one or several cells, and belongs to the largest of them.
struct Cells {
  int width = 100;  ///< width of the image, pixels
  int max_cell = 16;
  int size_of(std::uint32_t sample) const;
};

bool is_interactive(const renderer::Ray& ray, const Limits& limits, const Cells& cells);

/// Whether `a` goes before `b`: larger influence factor, then lower level, then larger cell.
bool goes_before(const renderer::Ray& a, const renderer::Ray& b, const Cells& cells);

/// The primary rays of the image in the order of their deposit: cells from the largest to the
/// smallest, those of one size in a random order drawn from `seed` (thesis, 4.3.7).
std::vector<renderer::Ray> make_initial_rays(const renderer::Scene& scene,
                                             const renderer::Params& params, const Cells& cells,
                                             std::uint64_t seed);

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
