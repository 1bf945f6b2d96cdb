#pragma once
// Declares the radiosity programs that experiments can run.
#include "simulator/parallel_radiosity/radiosity.hpp"
#include "simulator/parallel_radiosity/rooms.hpp"
#include "simulator/programs/declare/program.hpp"

namespace parallel_radiosity {

struct ProgramParams {
  RoomParams room;
  Params machine;      ///< distribution and costs; the member `solve` is set from `room`
  double amplify = 1;  ///< factor on the brightness of the difference image, 0 to 1e6
  /// The part of the picture's central line that is searched for the peak: from 0 (left edge) to 1
  /// (right edge).
  double peak_from = 0, peak_to = 1;
};

/// The program "radiosity": progressive radiosity on a simulated machine.
programs::Program make_radiosity();
/// The program "scan_line": one line of a room's picture. It simulates no machine.
programs::Program make_scan_line();

}  // namespace parallel_radiosity
