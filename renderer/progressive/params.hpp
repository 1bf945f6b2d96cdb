#pragma once
// Parameters of one step of a progressive rendering (thesis, 4.2.3).

#include <vector>

#include "renderer/trace/params.hpp"

namespace renderer::progressive {

/// Target of one step: how far the step refines the image.
struct Step {
  /// Contrast (thesis Eq 4.7) above which a cell is divided, 0..1. With 0, all cells are divided.
  double contrast = 0;
  int min_cell = 1;     ///< side of the smallest cell in pixels, a power of two
  bool pyramid = true;  ///< also divide cells that may hide an object (figure 4.4)
  int depth = 15;       ///< levels of the shading trees, 1..1000
  Area area;            ///< area of interest; cells outside it stay unchanged
};

/// Which quantity grows from step to step.
enum class StepKind : std::uint8_t {
  cells,  ///< cells are halved in each step; shading trees have full depth (figure 4.6)
  depth   ///< trees get one more level in each step; cells have full fineness (figure 4.5)
};

/// Makes the sequence of steps that ends with `last`. `max_cell` is the side of the first cells in
/// pixels.
std::vector<Step> make_steps(StepKind kind, int max_cell, const Step& last);
/// Makes the field "steps" of P, which selects a StepKind.
template <class P, class Access>
base::Field<P> step_kind_field(Access access) {
  return base::Declare<P>::choice(
      "steps", access,
      base::Names<StepKind>{{"cells", StepKind::cells}, {"depth", StepKind::depth}},
      "what changes from step to step: smaller cells, or deeper shading trees");
}

inline constexpr const char* EXPECTED_SIDE = "a power of two from 1 to 65536";
/// True if a cell may have this side in pixels.
bool is_side(int side);

/// Makes the fields contrast, min_cell and pyramid of Step.
base::Fields<Step> step_fields();
/// Makes a field of P for the side of a cell in pixels.
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
/// Makes the field "max_cell" of P: the side of the first cells, in pixels.
template <class P, class Access>
base::Field<P> max_cell_field(Access access) {
  return side_field<P>("max_cell", access, "side of the first cells, a power of two");
}

/// Throws BadInput with the name of the field, the value found and the values expected.
void check(const Step& step, const Params& params, int max_cell);

}  // namespace renderer::progressive
