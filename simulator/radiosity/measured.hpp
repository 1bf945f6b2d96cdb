#pragma once
// What a run of radiosity measures, and the columns that show it.
#include "simulator/radiosity/pictures.hpp"

namespace amp {

struct Measured {
  std::size_t patches = 0, vertices = 0;
  Result result;
  bool has_data = false;  ///< the geometry is kept by data managers
  PictureSummary shown;
};

/// Sizes, times, losses, loads, and what the pictures tell. Those of data managers and of the
/// reference are missing where there are none.
base::Columns<Measured> make_columns();

/// "81.0 % of the time is useful; the largest loss: 9.0 % waiting for ...".
std::string describe_loss(const Loss& loss, bool has_data);

}  // namespace amp
