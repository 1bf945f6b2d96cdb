#pragma once
// Where a room's light has gone.

#include "renderer/radiosity/mesh/mesh.hpp"

namespace radiosity {

/// Shares of the emitted power, all colours together. What was emitted is absorbed, unsent or
/// escaped.
struct Balance {
  double reflected = 0;  ///< counted at every reflection: may be more than 1
  double absorbed = 0;
  double unsent = 0;
  double escaped = 0;  ///< out of the room, to backs, or into mirrors; else an error
  double backs = 0;    ///< of `escaped`, estimated with rays: to backs; 0 where there are mirrors
};

/// The balance of what a mesh has emitted. By patch, in the mean over it: the light that has
/// arrived, and the radiosity that has not been sent.
Balance eval_balance(const Mesh& mesh, std::span<const Rgb> arrived, std::span<const Rgb> unsent);

/// Returns true if no light leaves the room: there is no mirror, and 16 rays from each patch all
/// meet a face. Then `escaped` should equal `backs`, the light that falls on backs of faces, for
/// example on that of a hanging lamp.
bool is_closed(const Mesh& mesh);

}  // namespace radiosity
