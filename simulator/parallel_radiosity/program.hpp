#pragma once
// Radiosity as programs for experiments.
#include "simulator/parallel_radiosity/radiosity.hpp"
#include "simulator/parallel_radiosity/rooms.hpp"
#include "simulator/programs/declare/program.hpp"

namespace parallel_radiosity {

struct ProgramParams {
  RoomParams room;
  Params machine;      ///< distribution and costs; `solve` is that of `room`
  double amplify = 1;  ///< factor for the difference image, 0 to 1e6
  /// Horizontal range of the picture's central line in which its peak is searched, in fractions of
  /// the width.
  double peak_from = 0, peak_to = 1;
};

/// The program "radiosity": progressive radiosity on a machine.
programs::Program make_radiosity();
/// The program "scan_line": a line of a room's picture, without a machine.
programs::Program make_scan_line();

}  // namespace parallel_radiosity
