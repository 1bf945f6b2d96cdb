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
  double escaped = 0;  ///< out of the room, to backs, or into mirrors; if it can not, an error
};

/// The balance of what a mesh has emitted. By patch, in the mean over it: the light that has
/// arrived, and the radiosity that has not been sent.
Balance eval_balance(const Mesh& mesh, std::span<const Rgb> arrived, std::span<const Rgb> unsent);

/// Whether nothing of the light can escape: there is no mirror, and rays from the middles of all
/// patches, 16 from each, meet fronts of faces.
bool is_closed(const Mesh& mesh);

}  // namespace radiosity
