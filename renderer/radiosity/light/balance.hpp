#pragma once
// Energy balance of a room's light.

#include "renderer/radiosity/mesh/mesh.hpp"

namespace radiosity {

/// Shares of the emitted power over all colours: absorbed + unsent + escaped = 1.
struct Balance {
  double reflected = 0;  ///< light is counted at every reflection, so the sum may exceed 1
  double absorbed = 0;
  double unsent = 0;
  /// the rest: light that left the room, fell on backs or into mirrors, and numerical error
  double escaped = 0;
  /// part of `escaped` that falls on backs, estimated by rays; 0 if there are mirrors
  double backs = 0;
};

/// Evaluates the balance of a solution. `arrived` and `unsent` have, for each patch, the mean light
/// that has arrived and the mean radiosity not sent yet.
Balance eval_balance(const Mesh& mesh, std::span<const Rgb> arrived, std::span<const Rgb> unsent);

/// True if no light leaves the room: it has no mirror, and 16 rays from each patch all meet a face.
/// In such a room `escaped` minus `backs` is the numerical error. (A closed room may contain backs,
/// such as that of a hanging lamp.)
bool is_closed(const Mesh& mesh);

}  // namespace radiosity
