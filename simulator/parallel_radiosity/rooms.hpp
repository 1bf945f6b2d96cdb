#pragma once
// Parts shared by the programs radiosity and scan_line: a room, its illumination and picture, and a
// reference solution, which is optional.
#include "base/fields.hpp"
#include "renderer/radiosity/creases/creases.hpp"
#include "renderer/radiosity/show/display.hpp"

namespace parallel_radiosity {

struct RoomParams {
  base::Source scene;
  radiosity::Creases creases = radiosity::Creases::file;
  radiosity::LightParams light;
  radiosity::ReconstructionParams reconstruction;
  radiosity::PictureParams picture;
  radiosity::Display display;
  base::Source reference;  ///< room of the reference; "" for the room of `scene`
  /// MeshParams::refine of the reference mesh, 1 to 1000. With 0, a reference named by `reference`
  /// has the refine of the scene; if `reference` is "", there is no reference.
  int reference_refine = 0;
  int reference_senders = 0;  ///< LightParams::senders of the reference
  /// Interpolation of the reference. The member twist of `reconstruction` is used in
  /// place of its own member twist.
  radiosity::ReconstructionParams shown_reference;
};

/// The field "scene", followed by the parameters of its mesh and its solution.
base::Fields<RoomParams> solution_fields();
/// The field "twist", followed by the parameters of drawing and displaying the picture.
base::Fields<RoomParams> view_fields();
/// The field "reference", followed by the parameters of its solution and interpolation.
base::Fields<RoomParams> reference_fields();

/// Throws base::BadInput, or std::invalid_argument that names the field, if the room of the scene
/// or of the reference cannot be read.
void check(const RoomParams& params);

/// Loads the scene's room, with the creases (lines along which its mesh is divided) that the
/// parameters choose.
radiosity::Room load_scene(const RoomParams& params);
/// Solves the reference with the scene's parameters, with three exceptions: `refine` and `senders`
/// are the reference's own, and the creases come from its file. Returns nothing if there is no
/// reference.
std::optional<radiosity::LitRoom> solve_reference(const RoomParams& params);
/// Draws the picture of the reference.
radiosity::Picture trace_reference(const RoomParams& params, const radiosity::LitRoom& reference,
                                   const renderer::View& view);
/// Marks each pixel that shows a light source in the picture of either mesh.
std::vector<bool> find_emitters(const RoomParams& params, const renderer::View& view,
                                const radiosity::Mesh& mesh, const radiosity::Mesh& other);

}  // namespace parallel_radiosity
