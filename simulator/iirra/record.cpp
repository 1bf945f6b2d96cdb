#include "simulator/iirra/record.hpp"

#include "base/errors.hpp"

namespace iirra {

void Record::finish(int x, int y, const Sample& sample) {
  const auto pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(samples.width) +
                     static_cast<std::size_t>(x);
  base::check_equal("a pixel is finished once", bool(finished[pixel]), false);
  finished[pixel] = true;
  samples.sums[pixel] = sample.sums;
  rays_image += sample.rays;
}

}  // namespace iirra
