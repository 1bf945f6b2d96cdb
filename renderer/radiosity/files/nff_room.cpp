#include "renderer/radiosity/files/nff_room.hpp"

#include <fmt/format.h>

#include <sstream>

#include "renderer/files/nff.hpp"
#include "renderer/radiosity/room/check.hpp"

namespace radiosity {

namespace {

struct RoomTarget : renderer::NffTarget {
  explicit RoomTarget(std::string file) : name(std::move(file)) {}

  std::string name;  // of the file
  Room room;
  Material material;  // of the faces to come
  bool used = false;  // whether it is the last of the room's materials

  bool takes_emission() const override { return true; }
  void set_view(const renderer::View& view) override { room.view = check_view(view); }
  void add_light(const Vec&, const std::optional<Rgb>&) override {}

  void set_surface(const renderer::Surface& s) override {
    if (s.t > 0) throw BadInput(fmt::format("found T {}, expected 0: opaque surfaces", s.t));
    const bool mirror = s.ks == 1 && s.kd == 0;
    set_material({{}, mirror ? Rgb{1, 1, 1} : s.kd * s.colour, {}, mirror});
  }
  void set_emission(const Rgb& emission) override {
    Material emitting = material;
    emitting.emission = emission;
    set_material(emitting);
  }
  void set_material(const Material& next) {
    check_material(next);
    material = next;
    material.name = fmt::format("line {}", line);
    used = false;
  }

  void add_polygon(std::vector<Vec> corners, std::vector<Vec> normals) override {
    if (!used) room.materials.push_back(material);
    used = true;
    Face face;
    face.corners = std::move(corners);
    face.normals = std::move(normals);
    face.material = static_cast<std::uint32_t>(room.materials.size() - 1);
    face.where = fmt::format("{}:{}", name, line);
    check_face(face, room.materials.size());
    room.faces.push_back(std::move(face));
  }
  void add_sphere(const Vec&, double) override { refuse("a sphere ('s')"); }
  void add_cone(const Vec&, double, const Vec&, double) override { refuse("a cone ('c')"); }
  [[noreturn]] static void refuse(const char* found) {
    throw BadInput(fmt::format("found {}, expected flat faces: p or pp", found));
  }
};

// The same lines, but `# emit` becomes a statement without its '#'.
std::stringstream uncover_emission(std::istream& in) {
  std::stringstream out;
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string hash, emit;
    words >> hash >> emit;
    if ((hash == "#" && emit == "emit") || hash == "#emit") line[line.find('#')] = ' ';
    out << line << '\n';
  }
  return out;
}

}  // namespace

Room read_nff_room(std::istream& in, const std::string& name) {
  std::stringstream lines = uncover_emission(in);
  RoomTarget target(name);
  read_nff(lines, name, target);
  check_light(target.room, name);
  return std::move(target.room);
}

}  // namespace radiosity
