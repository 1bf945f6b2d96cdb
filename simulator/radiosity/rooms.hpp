#pragma once
// What the programs over rooms share (radiosity, scan_line): a room, its illumination and its
// picture, and a reference that these are compared with.
#include "base/fields.hpp"
#include "renderer/radiosity/creases/creases.hpp"
#include "renderer/radiosity/show/display.hpp"

namespace amp {

struct RoomParams {
  base::Source scene;
  radiosity::Creases creases = radiosity::Creases::file;
  radiosity::LightParams light;
  radiosity::ReconstructionParams reconstruction;
  radiosity::PictureParams picture;
  radiosity::Display display;
  base::Source reference;     ///< another room; "": the scene
  int reference_refine = 0;   ///< MeshParams::refine, 0 to 1000; 0: the scene's if a reference is
                              ///< named, else there is none
  int reference_senders = 0;  ///< LightParams::senders
  radiosity::ReconstructionParams shown_reference;  ///< its twist is that of `reconstruction`
};

/// scene, then what says how it is meshed and solved.
base::Fields<RoomParams> solution_fields();
/// twist, then what says how the picture is made and shown.
base::Fields<RoomParams> view_fields();
/// reference and how it is solved and interpolated.
base::Fields<RoomParams> reference_fields();

/// Throws base::BadInput, and std::invalid_argument naming the field, for a room that cannot be
/// read, scene or reference.
void check(const RoomParams& params);

/// The scene, with the creases that its mesh keeps.
radiosity::Room load_scene(const RoomParams& params);
/// The reference, solved with the scene's parameters but its own `refine`, with the creases of its
/// file; none where the parameters name none.
std::optional<radiosity::LitRoom> solve_reference(const RoomParams& params);
/// The reference's picture.
radiosity::Picture trace_reference(const RoomParams& params, const radiosity::LitRoom& reference,
                                   const renderer::View& view);
/// For each pixel whether the picture of either mesh shows something there that emits.
std::vector<bool> find_emitters(const RoomParams& params, const renderer::View& view,
                                const radiosity::Mesh& mesh, const radiosity::Mesh& other);

}  // namespace amp
