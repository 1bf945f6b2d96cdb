#pragma once
// Parameters of one step of a progressive rendering (thesis, 4.2.3).

#include <vector>

#include "renderer/trace/params.hpp"

namespace renderer::progressive {

/// Target of one step.
struct Step {
  /// contrast (Eq 4.7) above which a cell is divided, 0..1; 0: divide all cells
  double contrast = 0;
  int min_cell = 1;     ///< side of the smallest cell, pixels, a power of two
  bool pyramid = true;  ///< true: also divide cells that may hide an object (figure 4.4)
  int depth = 15;       ///< levels of the shading trees, 1..1000
  Area area;            ///< area of interest; cells without a pixel in it stay unchanged
};

/// The quantity that grows from step to step.
enum class StepKind : std::uint8_t {
  cells,  ///< cells are halved in each step, with deep trees from the start (figure 4.6)
  depth   ///< trees grow by one level in each step, with small cells from the start (figure 4.5)
};

/// Makes the steps up to and including `last`.
std::vector<Step> make_steps(StepKind kind, int max_cell, const Step& last);
/// Makes the field "steps" of P.
template <class P, class Access>
base::Field<P> step_kind_field(Access access) {
  return base::Declare<P>::choice(
      "steps", access,
      base::Names<StepKind>{{"cells", StepKind::cells}, {"depth", StepKind::depth}},
      "what changes from step to step: smaller cells, or deeper shading trees");
}

inline constexpr const char* EXPECTED_SIDE = "a power of two from 1 to 65536";
/// True if a cell may have that side.
bool is_side(int side);

/// Makes the fields contrast, min_cell and pyramid.
base::Fields<Step> step_fields();
/// Makes a field of P for the side of a cell.
template <class P, class Access>
base::Field<P> side_field(const std::string& name, Access access, const std::string& help) {
  auto field = base::Declare<P>::whole(name, access, 1, MAX_SIDE, "pixels", help);
  field.domain.expected = EXPECTED_SIDE;
  using Side = base::detail::Member<P, Access>;
  field.write = [write = field.write](void* side, const base::Scalar& value) {
    return write(side, value) && is_side(*static_cast<const Side*>(side));
  };
  return field;
}
/// Makes the field "max_cell" of P: the side of the first cells.
template <class P, class Access>
base::Field<P> max_cell_field(Access access) {
  return side_field<P>("max_cell", access, "side of the first cells, a power of two");
}

/// Throws BadInput with the field, the value found and the values expected.
void check(const Step& step, const Params& params, int max_cell);

}  // namespace renderer::progressive
