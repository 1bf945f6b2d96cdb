#pragma once
// Light balance of a room.

#include "renderer/radiosity/mesh/mesh.hpp"

namespace radiosity {

/// Shares of the emitted power, all colours together; absorbed + unsent + escaped = 1.
struct Balance {
  double reflected = 0;  ///< counted at every reflection: may be more than 1
  double absorbed = 0;
  double unsent = 0;
  double escaped = 0;  ///< the rest: out of the room, to backs, into mirrors, and numerical error
  double backs = 0;    ///< part of `escaped` that falls on backs, a ray estimate; 0 with mirrors
};

/// The balance of what a mesh has emitted. By patch, in the mean over it: the light that has
/// arrived, and the radiosity that has not been sent.
Balance eval_balance(const Mesh& mesh, std::span<const Rgb> arrived, std::span<const Rgb> unsent);

/// Returns true if no light leaves the room: it has no mirror, and 16 rays from each patch all meet
/// a face. In such a room `escaped` minus `backs` is the numerical error. (A lamp that hangs has a
/// back.)
bool is_closed(const Mesh& mesh);

}  // namespace radiosity
