#pragma once
// What the programs over rooms share (radiosity, scan_line): their parameters, the room that these
// name, its illumination, and pictures of it.
#include "renderer/radiosity/light/solve.hpp"
#include "renderer/radiosity/show/picture.hpp"
#include "simulator/declare/program.hpp"

namespace programs {

// [program] keys: of the solution; of pictures; of a reference to compare with.
std::vector<Parameter> solution_parameters();
std::vector<Parameter> view_parameters();
std::vector<Parameter> reference_parameters();
// Throws for a room that cannot be read, scene or reference.
void check_rooms(const Setup& setup);

struct MeshedRoom {
  radiosity::Room room;
  radiosity::Mesh mesh;
};
MeshedRoom load_meshed_room(const Setup& setup);

// What a picture shows: a room and the radiosity of its vertices, ambient included if asked for.
struct LitRoom {
  MeshedRoom room;
  std::vector<radiosity::Rgb> vertices;
};
radiosity::SolveParams solve_params(const Setup& setup);
std::vector<radiosity::Rgb> light_vertices(const Setup& setup, const radiosity::Mesh& mesh,
                                           std::vector<radiosity::Rgb> vertices,
                                           const radiosity::Rgb& ambient);
// The reference, solved with the same parameters but its own `refine`, with the file's creases;
// none where the experiment names none.
std::optional<LitRoom> solve_reference(const Setup& setup);

// As program.reconstruction and others of the name say.
radiosity::ReconstructionParams reconstruction_params(const Setup& setup, std::string_view name);

// The room as program.scene's view sees it.
class Camera {
 public:
  Camera(const Setup& setup, const radiosity::Room& scene);
  radiosity::Picture take(const LitRoom& lit, const radiosity::ReconstructionParams& params) const;
  // The same by a z-buffer, as the display shows it on the way.
  radiosity::Picture preview(const radiosity::Mesh& mesh,
                             const std::vector<radiosity::Rgb>& vertices,
                             const radiosity::ReconstructionParams& params) const;
  // Of each pixel whether it shows something that emits, in a mirror too.
  std::vector<bool> find_emitters(const radiosity::Mesh& mesh) const;

 private:
  renderer::View view_;
  radiosity::PictureParams params_;
};

// As asked; else the one that shows best what does not emit.
radiosity::Display make_display(const Setup& setup, const radiosity::Picture& picture,
                                const std::vector<bool>& emitters);

}  // namespace programs
