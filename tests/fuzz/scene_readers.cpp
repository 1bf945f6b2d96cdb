#include "base/whole_file.hpp"
#include "renderer/files/load_scene.hpp"
#include "renderer/files/path.hpp"
#include "renderer/files/write_nff.hpp"
#include "renderer/radiosity/files/load_room.hpp"
#include "renderer/radiosity/room/check.hpp"
#include "tests/fuzz/kinds.hpp"

namespace fuzz {
namespace {

const std::string SCENES = "experiments/scenes";

// A file name in the project's folder of scenes, so that references to other files there work.
std::string name_scene(const std::string& ending) { return place_of(SCENES + "/fuzz" + ending); }

void read_nff(const std::string& text) {
  const std::string name = name_scene(".nff");
  renderer::parse_scene(text, name);
  renderer::parse_scene(text, name, 1);
}

// Reads a scene, and writes it as NFF. Reading this NFF must give the same scene.
void read_obj(const std::string& text) {
  const std::string name = name_scene(".obj");
  const auto write = [](const std::string& read, const std::string& as) {
    renderer::NffText nff(place_of(SCENES));
    renderer::read_scene(read, as, nff);
    return nff.text();
  };
  const std::string nff = write(text, name);
  expect_same("an OBJ as NFF, read again,",
              read_again("an OBJ as NFF", [&] { return write(nff, name_scene(".nff")); }), nff);
  renderer::parse_scene(text, name);
}

void read_path(const std::string& text) {
  const auto path = renderer::parse_path(text, "fuzz.path", false);
  for (std::size_t i = 1; i < path.size(); ++i)
    expect(path[i - 1].time < path[i].time, "times increase");
  for (const auto& row : path)
    expect(eval_path(path, row.time).place.x == row.place.x, "the path leads through its rows");
}

void read_room(const std::string& text, const std::string& ending) {
  const auto room = radiosity::read_room(text, name_scene(ending));
  try {
    radiosity::check(room);
  } catch (const base::BadInput& error) {
    throw Broken(fmt::format("a room that was read does not pass check(): {}", error.what()));
  }
}

constexpr std::string_view TRIANGLES =
    "mtllib fuzz.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
    "usemtl lamp\nf 1 2 3\nusemtl wall\nf 1 2 4\n";

void read_mtl(const std::string& text) {
  base::save_whole("fuzz.mtl", text);
  radiosity::check(radiosity::read_room(TRIANGLES, "fuzz.obj"));
}

}  // namespace

std::vector<Reader> scene_readers() {
  return {
      {"nff", ".nff", {SCENES}, read_nff},
      {"path", ".csv", {SCENES}, read_path},
      {"room", ".room", {SCENES}, [](const auto& text) { read_room(text, ".room"); }},
      {"nff-room", ".nff", {}, [](const auto& text) { read_room(text, ".nff"); }},
      {"obj", ".obj", {SCENES}, read_obj},
      {"obj-room", ".obj", {SCENES}, [](const auto& text) { read_room(text, ".obj"); }, "obj"},
      {"mtl", ".mtl", {SCENES}, read_mtl},
  };
}

}  // namespace fuzz
