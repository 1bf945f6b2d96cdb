// Meshes of other formats.
#include "renderer/meshes/read_mesh.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "renderer/files/write_obj.hpp"
#include "tests/renderer/support.hpp"
#include "tests/support/files.hpp"

namespace renderer::test {
namespace {

// Keeps the triangles.
struct Triangles : ObjTarget {
  std::vector<std::vector<Vec>> faces;
  std::vector<MtlMaterial> materials;

  void add_material(const MtlMaterial& material) override { materials.push_back(material); }
  void use_material(std::size_t material) override { ASSERT_LT(material, materials.size()); }
  void add_face(std::vector<Vec> corners, std::vector<Vec>, std::vector<Corner>) override {
    faces.push_back(std::move(corners));
  }
};

class ReadMesh : public ::testing::Test {
 protected:
  std::string save(const std::string& name, const std::string& text) {
    std::ofstream(folder_.path / name) << text;
    return (folder_.path / name).string();
  }

  ::test::TemporaryFolder folder_;
  LeftOut left_out_;
};

// A tetrahedron's corners and faces, which PLY and OFF list alike.
const std::string LISTS = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";
const std::string PLY_HEAD =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float "
    "z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n";

// Six times the volume that faces enclose.
double eval_volume(const std::vector<std::vector<Vec>>& faces) {
  double sum = 0;
  for (const auto& face : faces) sum += dot(face[0], cross(face[1], face[2]));
  return sum;
}

TEST_F(ReadMesh, ATetrahedronOfThreeFormats) {
  std::string stl = "solid t\n";
  const Vec corners[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const auto& face : {std::array{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}) {
    stl += "facet normal 0 0 0\nouter loop\n";
    for (const int i : face)
      stl += fmt::format("vertex {} {} {}\n", corners[i].x, corners[i].y, corners[i].z);
    stl += "endloop\nendfacet\n";
  }
  const std::string paths[] = {save("t.stl", stl + "endsolid t\n"),
                               save("t.ply", fmt::format(fmt::runtime(PLY_HEAD), 4) + LISTS),
                               save("t.off", "OFF\n4 4 6\n" + LISTS)};
  for (const auto& path : paths) {
    SCOPED_TRACE(path);
    Triangles triangles;
    read_mesh(path, triangles, left_out_);
    EXPECT_EQ(triangles.faces.size(), 4u);
    EXPECT_EQ(eval_volume(triangles.faces), 1) << "fronts are outside";
    EXPECT_EQ(triangles.materials.size(), 1u);
  }
  EXPECT_EQ(left_out_.describe(), "");
}

// One triangle with a colour, in a node that is moved and twice as large. Numbers are 0, 0, 0;
// 1, 0, 0; 0, 1, 0.
TEST_F(ReadMesh, AMeshIsWhereItsNodeIsAndHasItsColours) {
  const auto path = save("t.gltf", R"({"asset": {"version": "2.0"},
    "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,)"
                                   "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"
                                   R"("}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                   "min": [0, 0, 0], "max": [1, 1, 0]}],
    "materials": [{"name": "blue", "pbrMetallicRoughness": {"baseColorFactor": [0.125, 0.25, 0.5, 1]}}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
    "nodes": [{"mesh": 0, "translation": [1, 2, 3], "scale": [2, 2, 2]}],
    "scenes": [{"nodes": [0]}], "scene": 0})");
  Triangles triangles;
  read_mesh(path, triangles, left_out_);
  ASSERT_EQ(triangles.faces.size(), 1u);
  EXPECT_EQ(triangles.faces[0], (std::vector<Vec>{{1, 2, 3}, {3, 2, 3}, {1, 4, 3}}));
  const auto blue = std::ranges::find(triangles.materials, "blue", &MtlMaterial::name);
  ASSERT_NE(blue, triangles.materials.end());
  EXPECT_EQ(blue->diffuse, (Rgb{0.125, 0.25, 0.5}));
}

TEST_F(ReadMesh, TrianglesWithoutAreaAreCounted) {
  Triangles triangles;
  read_mesh(save("t.ply", fmt::format(fmt::runtime(PLY_HEAD), 5) + LISTS + "3 0 1 1\n"), triangles,
            left_out_);
  EXPECT_EQ(triangles.faces.size(), 4u);
  EXPECT_EQ(left_out_.describe(), "triangles without an area (1)");
}

TEST_F(ReadMesh, WhatIsNoMeshIsRefused) {
  for (const char* name : {"a.stl", "a.ply", "a.off", "a.dae", "a.3ds", "a.gltf", "a.glb"}) {
    const auto path = save(name, "no mesh\n");
    Triangles triangles;
    const auto error =
        ::test::message_of<base::BadInput>([&] { read_mesh(path, triangles, left_out_); });
    EXPECT_TRUE(error.starts_with(path + ": found")) << error;
  }
  Triangles triangles;
  EXPECT_NE(::test::message_of<base::BadInput>(
                [&] { read_mesh(folder_.path / "none.ply", triangles, left_out_); }),
            "");
}

}  // namespace
}  // namespace renderer::test
