#include "renderer/trace/pixel_tracer.hpp"

namespace renderer {

CornerObjects::CornerObjects(const Params& params, const Area& area) : area_(area) {
  if (is_adaptive(params.sampling))
    objects.resize(columns() * (static_cast<std::size_t>(area.height) + 1));
}

void CornerObjects::find_row(int row, SampleTracer& tracer) {
  for (int column = 0; column <= area_.width; ++column)
    objects[at(column, row)] = tracer.probe(area_.x + column, area_.y + row);
}

TracedPixel PixelTracer::finish(int column, int row, const TracedSample& first) {
  const Sampling& s = params_.sampling;
  const int x = area_.x + column, y = area_.y + row;
  if (!is_adaptive(s)) {
    TracedPixel pixel{first.sums, s.pixel_samples};
    for (int pass = 1; pass < s.pixel_samples; ++pass)
      add(pixel.sums, tracer_.trace(x, y, pass).sums);
    return pixel;
  }
  const Corners at_corners = corners_.of_pixel(column, row);
  samples_.assign(1, first);
  int has = 1;
  for (int wanted = first_round(s); has < wanted; wanted = find_wanted(s, samples_, at_corners))
    for (; has < wanted; ++has) samples_.push_back(tracer_.trace(x, y, has));
  return {eval_estimate(s, samples_, at_corners), has};
}

}  // namespace renderer
