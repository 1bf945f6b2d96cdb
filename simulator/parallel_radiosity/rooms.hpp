#pragma once
// Common parts of the programs over rooms (radiosity, scan_line): a room, its illumination and
// picture, and an optional reference.
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
  base::Source reference;     ///< another room; "": the scene
  int reference_refine = 0;   ///< MeshParams::refine, 0 to 1000; 0: the scene's if a reference is
                              ///< named, else there is none
  int reference_senders = 0;  ///< LightParams::senders
  radiosity::ReconstructionParams shown_reference;  ///< its twist is that of `reconstruction`
};

/// scene, then parameters of its mesh and solution.
base::Fields<RoomParams> solution_fields();
/// twist, then parameters of making and displaying the picture.
base::Fields<RoomParams> view_fields();
/// reference, then parameters of its solution and interpolation.
base::Fields<RoomParams> reference_fields();

/// Throws base::BadInput, and std::invalid_argument naming the field, if the scene's or the
/// reference's room cannot be read.
void check(const RoomParams& params);

/// The scene, with the creases chosen for its mesh.
radiosity::Room load_scene(const RoomParams& params);
/// The reference, solved with the scene's parameters but its own `refine` and its file's creases;
/// none if the parameters name none.
std::optional<radiosity::LitRoom> solve_reference(const RoomParams& params);
/// The reference's picture.
radiosity::Picture trace_reference(const RoomParams& params, const radiosity::LitRoom& reference,
                                   const renderer::View& view);
/// For each pixel, true if the picture of either mesh shows an emitter there.
std::vector<bool> find_emitters(const RoomParams& params, const renderer::View& view,
                                const radiosity::Mesh& mesh, const radiosity::Mesh& other);

}  // namespace parallel_radiosity
