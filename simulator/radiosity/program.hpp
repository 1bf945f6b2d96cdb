#pragma once
// Radiosity as programs of experiments.
#include "simulator/declare/program.hpp"
#include "simulator/radiosity/radiosity.hpp"
#include "simulator/radiosity/rooms.hpp"

namespace amp {

struct ProgramParams {
  RoomParams room;
  Params machine;                     ///< how the work is shared; `solve` is that of the room
  double amplify = 1;                 ///< factor of the difference image, 0 to 1e6
  double peak_from = 0, peak_to = 1;  ///< part of the picture's width where the largest value of
                                      ///< its central line is looked for, 0 to 1
};

/// "radiosity": progressive radiosity on a machine.
programs::Program make_radiosity();
/// "scan_line": a line of a room's picture, without a machine.
programs::Program make_scan_line();

}  // namespace amp
