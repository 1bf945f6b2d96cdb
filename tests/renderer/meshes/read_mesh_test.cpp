// Tests the reader of mesh formats other than OBJ and NFF.
#include "renderer/meshes/read_mesh.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "renderer/files/write_obj.hpp"
#include "tests/renderer/support.hpp"
#include "tests/support/files.hpp"

namespace renderer::test {
namespace {

// A target that collects triangles.
struct Triangles : ObjTarget {
  std::vector<std::vector<Vec>> faces;
  std::vector<std::vector<Corner>> coordinates;
  std::vector<MtlMaterial> materials;

  void add_material(const MtlMaterial& material) override { materials.push_back(material); }
  void use_material(std::size_t material) override { ASSERT_LT(material, materials.size()); }
  void add_face(std::vector<Vec> corners, std::vector<Vec>, std::vector<Corner> of_face) override {
    faces.push_back(std::move(corners));
    coordinates.push_back(std::move(of_face));
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

// The corners and faces of a tetrahedron, in the form used by both PLY and OFF files.
const std::string LISTS = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";
const std::string PLY_HEAD =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float "
    "z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n";

// Six times the volume that the faces enclose.
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

// Makes a glTF file with one triangle, (0, 0, 0), (1, 0, 0), (0, 1, 0), in a node that has a
// material.
std::string make_gltf(const std::string& material, const std::string& moved = "") {
  return R"({"asset": {"version": "2.0"},
    "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,)"
         "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"
         R"("}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                   "min": [0, 0, 0], "max": [1, 1, 0]}],
    "images": [{"uri": "wood.png"}, {"uri": "bumps.png"}],
    "textures": [{"source": 0}, {"source": 1}],
    "materials": [)" +
         material + R"(],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
    "nodes": [{"mesh": 0)" +
         moved + R"(}],
    "scenes": [{"nodes": [0]}], "scene": 0})";
}

// The file's node moves the triangle and scales it by two.
TEST_F(ReadMesh, AMeshIsWhereItsNodeIsAndHasItsColours) {
  const auto path = save("t.gltf", make_gltf(R"({"name": "blue", "pbrMetallicRoughness":
                                                 {"baseColorFactor": [0.125, 0.25, 0.5, 1]}})",
                                             R"(, "translation": [1, 2, 3], "scale": [2, 2, 2])"));
  Triangles triangles;
  read_mesh(path, triangles, left_out_);
  ASSERT_EQ(triangles.faces.size(), 1u);
  EXPECT_EQ(triangles.faces[0], (std::vector<Vec>{{1, 2, 3}, {3, 2, 3}, {1, 4, 3}}));
  const auto blue = std::ranges::find(triangles.materials, "blue", &MtlMaterial::name);
  ASSERT_NE(blue, triangles.materials.end());
  EXPECT_EQ(blue->diffuse, (Rgb{0.125, 0.25, 0.5}));
}

TEST_F(ReadMesh, OnlyPicturesOfColoursAreKept) {
  Triangles triangles;
  read_mesh(save("t.gltf", make_gltf(R"({"name": "wooden", "normalTexture": {"index": 1},
                                         "pbrMetallicRoughness":
                                             {"baseColorTexture": {"index": 0}}})")),
            triangles, left_out_);
  const auto wooden = std::ranges::find(triangles.materials, "wooden", &MtlMaterial::name);
  ASSERT_NE(wooden, triangles.materials.end());
  EXPECT_EQ(wooden->picture, (folder_.path / "wood.png").string());
  EXPECT_EQ(left_out_.describe(), "pictures for properties other than colour (1)");
}

TEST_F(ReadMesh, AMaterialHasItsColoursAndNumbers) {
  const auto path = save("t.dae", R"(<?xml version="1.0" encoding="utf-8"?>
    <COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
    <asset><up_axis>Y_UP</up_axis></asset>
    <library_effects><effect id="e"><profile_COMMON><technique sid="common"><phong>
    <emission><color>0.5 0 1 1</color></emission>
    <diffuse><color>0.125 0.25 0.5 1</color></diffuse>
    <specular><color>0.75 0.5 0.25 1</color></specular>
    <shininess><float>20</float></shininess>
    <transparency><float>0.75</float></transparency>
    <index_of_refraction><float>1.5</float></index_of_refraction>
    </phong></technique></profile_COMMON></effect></library_effects>
    <library_materials><material id="m" name="glass"><instance_effect url="#e"/></material>
    </library_materials>
    <library_geometries><geometry id="g"><mesh>
    <source id="p"><float_array id="a" count="9">0 0 0 1 0 0 0 1 0</float_array>
    <technique_common><accessor source="#a" count="3" stride="3"><param name="X" type="float"/>
    <param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common>
    </source>
    <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
    <triangles count="1" material="s"><input semantic="VERTEX" source="#v" offset="0"/>
    <p>0 1 2</p></triangles></mesh></geometry></library_geometries>
    <library_visual_scenes><visual_scene id="c"><node><instance_geometry url="#g"><bind_material>
    <technique_common><instance_material symbol="s" target="#m"/></technique_common>
    </bind_material></instance_geometry></node></visual_scene></library_visual_scenes>
    <scene><instance_visual_scene url="#c"/></scene></COLLADA>)");
  Triangles triangles;
  read_mesh(path, triangles, left_out_);
  const auto glass = std::ranges::find(triangles.materials, "glass", &MtlMaterial::name);
  ASSERT_NE(glass, triangles.materials.end());
  EXPECT_EQ(glass->diffuse, (Rgb{0.125, 0.25, 0.5}));
  EXPECT_EQ(glass->specular, (Rgb{0.75, 0.5, 0.25}));
  EXPECT_EQ(glass->emission, (Rgb{0.5, 0, 1}));
  EXPECT_EQ(glass->shine, 20);
  EXPECT_EQ(glass->transparency, 0.25);
  EXPECT_EQ(glass->ior, 1.5);
}

// STL and PLY files contain no materials.
TEST_F(ReadMesh, WithoutAMaterialATriangleIsOpaque) {
  Triangles triangles;
  read_mesh(save("t.ply", fmt::format(fmt::runtime(PLY_HEAD), 4) + LISTS), triangles, left_out_);
  ASSERT_EQ(triangles.materials.size(), 1u);
  EXPECT_EQ(triangles.materials[0].transparency, 0);
  EXPECT_EQ(triangles.materials[0].ior, 1);
}

// If one texture coordinate of a triangle exceeds the limit, the triangle loses all of them.
TEST_F(ReadMesh, CoordinatesAreKeptUpToAMillion) {
  Triangles triangles;
  read_mesh(save("t.ply",
                 "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
                 "property float z\nproperty float s\nproperty float t\nelement face 2\n"
                 "property list uchar int vertex_indices\nend_header\n0 0 0 0 0\n"
                 "1 0 0 1e6 0.25\n0 1 0 0.5 -1e6\n0 0 1 2e6 1\n3 0 1 2\n3 0 1 3\n"),
            triangles, left_out_);
  ASSERT_EQ(triangles.coordinates.size(), 2u);
  const auto& kept = triangles.coordinates[0];
  ASSERT_EQ(kept.size(), 3u);
  const double expected[][2] = {{0, 0}, {1e6, 0.25}, {0.5, -1e6}};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(kept[i].u, expected[i][0]);
    EXPECT_EQ(kept[i].v, expected[i][1]);
  }
  EXPECT_TRUE(triangles.coordinates[1].empty());
  EXPECT_EQ(left_out_.describe(), "texture coordinates beyond a million (3)");
}

TEST_F(ReadMesh, TrianglesWithoutAreaAreCounted) {
  Triangles triangles;
  read_mesh(save("t.ply", fmt::format(fmt::runtime(PLY_HEAD), 5) + LISTS + "3 0 1 1\n"), triangles,
            left_out_);
  EXPECT_EQ(triangles.faces.size(), 4u);
  EXPECT_EQ(left_out_.describe(), "triangles with area 0 (1)");
}

TEST_F(ReadMesh, WhatIsReadButHasNoMeshIsRefused) {
  const auto path =
      save("t.gltf", R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": []}], "scene": 0})");
  Triangles triangles;
  EXPECT_EQ(::test::message_of<base::BadInput>([&] { read_mesh(path, triangles, left_out_); }),
            path + ": found none, expected a mesh of triangles");
}

// The error message quotes the reason that the library gives.
TEST_F(ReadMesh, WhatIsNoMeshIsRefused) {
  for (const char* name : {"a.stl", "a.ply", "a.off", "a.dae", "a.3ds", "a.gltf", "a.glb"}) {
    const auto path = save(name, "no mesh\n");
    Triangles triangles;
    const auto error =
        ::test::message_of<base::BadInput>([&] { read_mesh(path, triangles, left_out_); });
    EXPECT_TRUE(error.starts_with(path + ": found ")) << error;
    EXPECT_TRUE(error.ends_with(", expected a mesh of triangles")) << error;
  }
  Triangles triangles;
  EXPECT_NE(::test::message_of<base::BadInput>(
                [&] { read_mesh(folder_.path / "none.ply", triangles, left_out_); }),
            "");
}

}  // namespace
}  // namespace renderer::test
