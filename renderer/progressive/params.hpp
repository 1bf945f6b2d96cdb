#pragma once
// What one step of a progressive rendering is asked for (thesis, 4.2.3).

#include <vector>

#include "renderer/trace/params.hpp"

namespace renderer::progressive {

/// How far a step goes.
struct Step {
  double contrast =
      0;             ///< contrast (Eq 4.7), 0..1, above which a cell is divided; 0: every cell is
  int min_cell = 1;  ///< smallest cell, pixels a side: a power of two
  bool pyramid = true;  ///< whether a cell is divided too that may hide an object (figure 4.4)
  int depth = 15;       ///< levels of the shading trees, 1..1000
  Area area;            ///< of interest: cells that have no pixel in it stay as they are
};

/// In what an image grows from step to step.
enum class Growth : std::uint8_t {
  cells,  ///< their size is halved, from the first cells' to the last step's; trees are deep (4.6)
  depth   ///< trees grow by a level, from 1 to the last step's; cells are small (figure 4.5)
};

/// The steps that lead to the last one.
std::vector<Step> make_steps(Growth growth, int max_cell, const Step& last);
/// The field "steps" of P.
template <class P, class Access>
base::Field<P> growth_field(Access access) {
  return base::Declare<P>::choice(
      "steps", access, base::Names<Growth>{{"cells", Growth::cells}, {"depth", Growth::depth}},
      "what grows: ever smaller cells, or ever deeper trees");
}

/// The fields contrast, min_cell and pyramid.
base::Fields<Step> step_fields();
/// The field "max_cell" of P: the side of the first cells, pixels, a power of two.
template <class P, class Access>
base::Field<P> max_cell_field(Access access) {
  return base::Declare<P>::whole("max_cell", access, 1, MAX_SIDE, "pixels",
                                 "side of the first cells, a power of two");
}

/// BadInput naming the field, what was found and what was expected.
void check(const Step& step, const Params& params, int max_cell);

}  // namespace renderer::progressive
