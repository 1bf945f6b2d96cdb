#pragma once
// Energy balance of the light in a room.

#include "renderer/radiosity/mesh/mesh.hpp"

namespace radiosity {

/// Fractions of the emitted power, summed over the colours: absorbed + unsent + escaped = 1.
struct Balance {
  double reflected = 0;  ///< light counts at every reflection, so this may exceed 1
  double absorbed = 0;
  double unsent = 0;
  /// The rest of the emitted power: light that left the room or fell on the backs of faces or on
  /// mirrors, and numerical error.
  double escaped = 0;
  /// The part of `escaped` that falls on the backs of faces, estimated by rays. 0 in rooms with
  /// mirrors.
  double backs = 0;
};

/// Evaluates the balance of a solution. For each patch, `arrived` is the mean light that has
/// arrived, and `unsent` is the mean radiosity that has not yet been sent.
Balance eval_balance(const Mesh& mesh, std::span<const Rgb> arrived, std::span<const Rgb> unsent);

/// True if no light leaves the room: there is no mirror, and each of 16 rays from each patch meets
/// a face. In such a room, `escaped` minus `backs` is the numerical error. (Faces in a closed room
/// may still show their backs, as a hanging lamp does.)
bool is_closed(const Mesh& mesh);

}  // namespace radiosity
