#include "simulator/iirra/record.hpp"

#include "base/errors.hpp"

namespace iirra {

void Record::finish(int x, int y, const renderer::Samples::Sums& sums,
                    const renderer::RayCounts& of_pixel) {
  const auto pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(samples.width) +
                     static_cast<std::size_t>(x);
  base::check_equal("a pixel is finished once", bool(finished[pixel]), false);
  finished[pixel] = true;
  samples.sums[pixel] = sums;
  rays_image += of_pixel;
}

}  // namespace iirra
