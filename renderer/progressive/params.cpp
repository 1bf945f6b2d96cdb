#include "renderer/progressive/params.hpp"

#include <bit>

#include "renderer/scene/require.hpp"

namespace renderer::progressive {

static_assert(MAX_SIDE == 65536, "EXPECTED_SIDE says so");

bool is_side(int side) {
  return side >= 1 && side <= MAX_SIDE && std::has_single_bit(static_cast<unsigned>(side));
}

std::vector<Step> make_steps(StepKind kind, int max_cell, const Step& last) {
  std::vector<Step> steps;
  Step step = last;
  if (kind == StepKind::cells)
    for (step.min_cell = max_cell; step.min_cell >= last.min_cell; step.min_cell /= 2)
      steps.push_back(step);
  else
    for (step.depth = 1; step.depth <= last.depth; ++step.depth) steps.push_back(step);
  return steps;
}

base::Fields<Step> step_fields() {
  using D = base::Declare<Step>;
  return {
      D::number("contrast", &Step::contrast, 0, 1, "",
                "contrast above which a cell is divided; 0: divide every cell"),
      side_field<Step>("min_cell", &Step::min_cell, "side of the smallest cells, a power of two"),
      D::flag("pyramid", &Step::pyramid,
              "true: also divide cells whose samples may miss an object")};
}

void check(const Step& step, const Params& params, int max_cell) {
  require_allowed(step_fields(), step);
  require(is_side(max_cell), "max_cell", max_cell, EXPECTED_SIDE);
  require(is_side(step.min_cell), "min_cell", step.min_cell, EXPECTED_SIDE);
  require(step.min_cell <= max_cell, "min_cell", step.min_cell,
          fmt::format("at most max_cell, {}", max_cell));
  Params asked = params;
  asked.limits.depth = step.depth;
  asked.area = step.area;
  renderer::check(asked);
}

}  // namespace renderer::progressive
