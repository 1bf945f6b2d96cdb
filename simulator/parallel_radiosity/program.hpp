#pragma once
// Radiosity as experiment programs.
#include "simulator/parallel_radiosity/radiosity.hpp"
#include "simulator/parallel_radiosity/rooms.hpp"
#include "simulator/programs/declare/program.hpp"

namespace parallel_radiosity {

struct ProgramParams {
  RoomParams room;
  Params machine;                     ///< distribution of the work; `solve` is the room's
  double amplify = 1;                 ///< factor of the difference image, 0 to 1e6
  double peak_from = 0, peak_to = 1;  ///< part of the picture's width, 0 to 1, to search for the
                                      ///< largest value of its central line
};

/// "radiosity": progressive radiosity on a machine.
programs::Program make_radiosity();
/// "scan_line": a line of a room's picture, without a machine.
programs::Program make_scan_line();

}  // namespace parallel_radiosity
