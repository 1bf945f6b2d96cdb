#pragma once
// How far a picture is from a reference, all over and along a line.
#include "simulator/radiosity/rooms.hpp"

namespace programs {

struct PictureError {
  double image = 0;  // root mean square of the difference over that of the reference; linear
  // Along the line, red: the same, and the difference of the largest values over the reference's.
  double line = 0, line_peak = 0;                // of displayed values, 0..255
  double line_linear = 0, line_peak_linear = 0;  // of radiosity
  int peak_shift = 0;                            // pixels, from the reference's to the picture's
};

// Where pictures are compared.
struct Compared {
  std::vector<bool> left_out;         // pixels of what emits
  int line = 0;                       // from the top
  double peak_from = 0, peak_to = 1;  // of the width, where the largest value is looked for
};

// Of pictures of one size.
PictureError compare_pictures(const radiosity::Picture& picture,
                              const radiosity::Picture& reference,
                              const radiosity::Display& display, const Compared& where);

// What the display shows of each pixel, 0..1.
radiosity::Picture make_displayed(const radiosity::Picture& picture,
                                  const radiosity::Display& display);

}  // namespace programs
