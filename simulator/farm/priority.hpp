#pragma once
// Increasing realism: the rays that matter now, and their order (thesis, 4.3.2, 4.3.4).
#include "renderer/trace/shade.hpp"

namespace farm {

/// The user's parameters of increasing realism. A ray within all of them is "in interactive mode"
/// (RMI); one beyond any waits for the non-interactive phase (RMNI).
struct Limits {
  double min_influence = 0.0;    ///< influence factor, at least
  int depth_reflected = 1000;    ///< level, at most, of rays with only reflections before them
  int depth_transmitted = 1000;  ///< level, at most, of transmitted rays and their descendants
  int min_cell = 1;              ///< pixels, size of the image cell, at least
  renderer::Area area;           ///< of interest; 0 x 0: the whole image
  bool operator==(const Limits&) const = default;
};

/// Image cells: the image is tiled with squares of `max_cell` pixels (a power of two), each divided
/// in four again and again; a sample belongs to the largest cell whose upper-left corner it is.
struct Cells {
  int width = 100;  ///< of the image, pixels
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

}  // namespace farm
