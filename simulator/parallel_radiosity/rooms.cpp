#include "simulator/parallel_radiosity/rooms.hpp"

#include "renderer/radiosity/files/load_room.hpp"
#include "renderer/radiosity/light/solve.hpp"
#include "renderer/radiosity/show/display.hpp"

namespace parallel_radiosity {

using R = RoomParams;
using D = base::Declare<R>;

base::Fields<R> solution_fields() {
  const auto mesh = [](auto& r) -> auto& { return r.light.mesh; };
  const auto solve = [](auto& r) -> auto& { return r.light.solve; };
  return base::join(
      base::Fields<R>{D::file("scene", &R::scene, "file of the room: .room, .nff or .obj", true)},
      {base::lift_all<R>(radiosity::mesh_fields(), mesh),
       {base::lift<R>(radiosity::creases_field(), &R::creases)},
       base::lift_all<R>(radiosity::solve_fields(), solve)});
}

base::Fields<R> view_fields() {
  static const base::Names<bool> AMBIENT = {{"added", true}, {"left-out", false}};
  const auto ambient = [](auto& r) -> auto& { return r.light.ambient; };
  const auto twist = base::select(radiosity::reconstruction_fields(), {"twist"});
  const auto picture =
      base::select(radiosity::picture_fields(), {"width", "height", "pixel_samples"});
  return base::join(
      base::lift_all<R>(twist, &R::reconstruction),
      {{D::choice("ambient", ambient, AMBIENT,
                  "an estimate of the light that is still unsent: added or left out")},
       base::lift_all<R>(picture, &R::picture),
       base::lift_all<R>(radiosity::display_fields(), &R::display)});
}

base::Fields<R> reference_fields() {
  auto shown =
      base::lift_all<R>(base::select(radiosity::reconstruction_fields(), {"reconstruction"}),
                        &R::shown_reference, "reference_");
  shown[0].help = "interpolation of the reference's illumination";
  return base::join(
      base::Fields<R>{
          D::file("reference", &R::reference, "a room to compare with; none: the scene itself"),
          D::whole("reference_refine", &R::reference_refine, 0, 1000, "",
                   "`refine` of the reference; 0: that of the scene if a reference is named, else "
                   "no comparison"),
          D::whole("reference_senders", &R::reference_senders, 0, 1000, "",
                   "`refine` of the reference's coarser patches that send light to the vertices of "
                   "the finer ones; 0: the finer patches send it")},
      {shown});
}

void check(const R& params) {
  radiosity::check(params.light.solve.factor);
  for (const auto* room : {&params.scene, &params.reference})
    if (!room->path.empty()) radiosity::load_room(room->path);
}

radiosity::Room load_scene(const R& params) {
  auto room = radiosity::load_room(params.scene.path);
  choose_creases(room, params.creases);
  return room;
}

std::optional<radiosity::LitRoom> solve_reference(const R& params) {
  const bool is_named = !params.reference.path.empty();
  if (!is_named && params.reference_refine == 0) return {};
  auto light = params.light;
  if (params.reference_refine > 0) light.mesh.refine = params.reference_refine;
  light.senders = params.reference_senders;
  const auto& room = is_named ? params.reference : params.scene;
  return light_room(radiosity::load_room(room.path), light);
}

radiosity::Picture trace_reference(const R& params, const radiosity::LitRoom& reference,
                                   const renderer::View& view) {
  return trace_picture(reference, {params.shown_reference.kind, params.reconstruction.twist}, view,
                       params.picture);
}

std::vector<bool> find_emitters(const R& params, const renderer::View& view,
                                const radiosity::Mesh& mesh, const radiosity::Mesh& other) {
  auto emitters = find_emitters(mesh, view, params.picture);
  const auto others = find_emitters(other, view, params.picture);
  for (std::size_t i = 0; i < emitters.size(); ++i) emitters[i] = emitters[i] || others[i];
  return emitters;
}

}  // namespace parallel_radiosity
