#include "simulator/radiosity/rooms.hpp"

#include "renderer/radiosity/creases/discontinuities.hpp"
#include "renderer/radiosity/files/load_room.hpp"
#include "renderer/radiosity/light/relight.hpp"

namespace programs {

namespace {

using radiosity::MeshParams;
using radiosity::Rgb;

radiosity::Room load_with_creases(const std::string& path, const std::string& creases) {
  auto room = radiosity::load_room(path);
  if (creases == "none") room.creases.clear();
  if (creases != "auto") return room;
  const auto found = find_creases(room);
  room.creases.insert(room.creases.end(), found.begin(), found.end());
  return room;
}

radiosity::Mesh make_refined(const radiosity::Room& room, std::int64_t refine) {
  MeshParams params;
  params.refine = static_cast<int>(refine);
  return make_mesh(room, params);
}

MeshedRoom make_meshed(radiosity::Room room, std::int64_t refine) {
  auto mesh = make_refined(room, refine);
  return {std::move(room), std::move(mesh)};
}

}  // namespace

std::vector<Parameter> solution_parameters() {
  return {
      make_path("scene", "the room: .room, .nff or .obj", true),
      {"refine", 1, 1, 1000, true, "multiplies the divisions of every face of the room"},
      make_choice(
          "creases", {"file", "auto", "none"},
          "borders of penumbrae that patches keep: the room's; these and others that are found; "
          "none"),
      {"samples", 1, 1, 1024, true, "a patch is cut into samples x samples delta areas"},
      {"spread", 0.18, 1e-6, 1e6, false,
       "and a delta area in half while it is wider than this share of its distance"},
      {"halvings", 12, 0, 30, true, "at most so many times"},
      {"reflections", 2, 0, radiosity::MOST_REFLECTIONS, true,
       "mirrors that light may meet on its way"},
      {"mirror_pieces", 0, 0, 1000, true,
       "a mirror is cut into so many pieces along and across; 0: as each delta area needs"},
      {"mirror_share", 0.5, 1e-6, 1e9, false,
       "a delta area that is seen in mirrors is halved while it looks wider than this share of "
       "them"},
      make_choice("mean", {"simpson", "corners"},
                  "what a patch has received: a twelfth of each corner's and two thirds of the "
                  "centre's; or the mean of its corners"),
      {"max_shots", 1e6, 0, 1e9, true, "that patches send their light, at most"},
      {"tolerance", 0.001, 0, 1, false, "until this share of the emitted power is unsent"},
  };
}

void check_rooms(const Setup& setup) {
  radiosity::check(solve_params(setup).factor);
  for (const char* name : {"scene", "reference"})
    if (const auto& path = setup.path(name); !path.empty()) radiosity::load_room(path);
}

MeshedRoom load_meshed_room(const Setup& setup) {
  return make_meshed(load_with_creases(setup.path("scene"), setup.choice("creases")),
                     setup.whole("refine"));
}

radiosity::SolveParams solve_params(const Setup& setup) {
  radiosity::SolveParams params;
  params.factor.samples = static_cast<int>(setup.whole("samples"));
  params.factor.spread = setup["spread"];
  params.factor.halvings = static_cast<int>(setup.whole("halvings"));
  params.factor.reflections = static_cast<int>(setup.whole("reflections"));
  params.factor.mirror_pieces = static_cast<int>(setup.whole("mirror_pieces"));
  params.factor.mirror_share = setup["mirror_share"];
  params.mean =
      setup.choice("mean") == "simpson" ? radiosity::Mean::simpson : radiosity::Mean::corners;
  params.shots = static_cast<int>(setup.whole("max_shots"));
  params.tolerance = setup["tolerance"];
  return params;
}

std::vector<Rgb> light_vertices(const Setup& setup, const radiosity::Mesh& mesh,
                                std::vector<Rgb> vertices, const Rgb& ambient) {
  if (setup.choice("ambient") == "added") add_ambient(mesh, ambient, vertices);
  return vertices;
}

std::optional<LitRoom> solve_reference(const Setup& setup) {
  const auto& named = setup.path("reference");
  const auto refine = setup.whole("reference_refine");
  if (named.empty() && refine == 0) return {};
  LitRoom lit{make_meshed(radiosity::load_room(named.empty() ? setup.path("scene") : named),
                          refine > 0 ? refine : setup.whole("refine")),
              {}};
  const auto senders = setup.whole("reference_senders");
  const auto solution = senders > 0 ? relight(make_refined(lit.room.room, senders), lit.room.mesh,
                                              solve_params(setup))
                                    : solve(lit.room.mesh, solve_params(setup));
  lit.vertices = light_vertices(setup, lit.room.mesh, solution.vertices, solution.ambient);
  return lit;
}

}  // namespace programs
