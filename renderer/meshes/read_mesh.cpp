#include "renderer/meshes/read_mesh.hpp"

#include <assimp/DefaultIOSystem.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <sys/stat.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <filesystem>

#include "base/text.hpp"
#include "base/whole_file.hpp"
#include "renderer/files/text/statements.hpp"
#include "renderer/files/text/tokens.hpp"
#include "renderer/files/write_nff.hpp"
#include "renderer/scene/primitives.hpp"

namespace renderer {

namespace {

// Opens files for Assimp and remembers them as inputs, which tlab never overwrites. A mesh may
// consist of several files, such as a .gltf file and its buffers.
class RememberedFiles : public Assimp::DefaultIOSystem {
 public:
  Assimp::IOStream* Open(const char* file, const char* mode) override {
    struct stat found {};
    if (stat(file, &found) == 0) base::note_input(found);
    return DefaultIOSystem::Open(file, mode);
  }
};

Vec to_vec(const aiVector3D& v) { return {v.x, v.y, v.z}; }

class Teller {
 public:
  Teller(const aiScene& scene, const std::string& path, ObjTarget& target, LeftOut& left_out)
      : scene_(scene), path_(path), target_(target), left_out_(left_out) {}

  void tell() {
    for (unsigned i = 0; i < scene_.mNumMaterials; ++i) tell_material(*scene_.mMaterials[i]);
    for (unsigned i = 0; i < scene_.mNumMeshes; ++i) tell_mesh(*scene_.mMeshes[i]);
    base::require(told_ > 0, path_, "found no triangle with an area above 0, expected one or more");
    left_out_.add("lights", "", scene_.mNumLights);
    left_out_.add("cameras", "", scene_.mNumCameras);
    left_out_.add("animations", "", scene_.mNumAnimations);
  }

 private:
  void tell_material(const aiMaterial& material) {
    MtlMaterial m{.name = names_.make(material.GetName().C_Str())};
    const auto colour = [&](const char* key, unsigned type, unsigned index, const Rgb& otherwise) {
      aiColor3D c;
      if (material.Get(key, type, index, c) != aiReturn_SUCCESS) return otherwise;
      return Rgb{std::clamp<double>(c.r, 0, MAX_COLOUR), std::clamp<double>(c.g, 0, MAX_COLOUR),
                 std::clamp<double>(c.b, 0, MAX_COLOUR)};
    };
    const auto number = [&](const char* key, unsigned type, unsigned index, double least,
                            double most, double otherwise) {
      float x = 0;
      if (material.Get(key, type, index, x) != aiReturn_SUCCESS) return otherwise;
      return std::isfinite(x) ? std::clamp<double>(x, least, most) : otherwise;
    };
    m.set_diffuse(colour(AI_MATKEY_COLOR_DIFFUSE, {0.8, 0.8, 0.8}));
    m.specular = colour(AI_MATKEY_COLOR_SPECULAR, {});
    m.emission = colour(AI_MATKEY_COLOR_EMISSIVE, {});
    m.shine = number(AI_MATKEY_SHININESS, 0, MAX_SHINE, 0);
    m.transparency = 1 - number(AI_MATKEY_OPACITY, 0, 1, 1);
    m.ior = number(AI_MATKEY_REFRACTI, 1e-3, MAX_IOR, 1);
    for (int type = 0; type <= AI_TEXTURE_TYPE_MAX; ++type)
      if (type != aiTextureType_DIFFUSE && type != aiTextureType_BASE_COLOR)
        left_out_.add("pictures for properties other than colour", "",
                      material.GetTextureCount(static_cast<aiTextureType>(type)));
    aiString picture;
    if (material.GetTexture(aiTextureType_DIFFUSE, 0, &picture) == aiReturn_SUCCESS)
      tell_picture(picture.C_Str(), m);
    target_.add_material(m);
  }

  // Sets the picture of a material if it is a separate file. Counts embedded pictures as left out.
  void tell_picture(const std::string& name, MtlMaterial& material) {
    if (scene_.GetEmbeddedTexture(name.c_str()))
      left_out_.add("embedded pictures");
    else
      material.picture = (std::filesystem::path(path_).parent_path() / name).string();
  }

  void tell_mesh(const aiMesh& mesh) {
    if (!(mesh.mPrimitiveTypes & aiPrimitiveType_TRIANGLE)) {
      const bool is_lines = mesh.mPrimitiveTypes & aiPrimitiveType_LINE;
      return left_out_.add(is_lines ? "lines" : "points", "", mesh.mNumFaces);
    }
    if (mesh.HasVertexColors(0)) left_out_.add("colours of vertices", "", mesh.mNumVertices);
    target_.use_material(mesh.mMaterialIndex);
    for (unsigned i = 0; i < mesh.mNumFaces; ++i) tell_face(mesh, mesh.mFaces[i]);
  }

  void tell_face(const aiMesh& mesh, const aiFace& face) {
    std::vector<Vec> corners, normals;
    std::vector<Corner> coordinates;
    for (unsigned i = 0; i < face.mNumIndices; ++i) {
      const unsigned at = face.mIndices[i];
      corners.push_back(to_vec(mesh.mVertices[at]));
      if (mesh.HasNormals()) normals.push_back(to_vec(mesh.mNormals[at]));
      if (mesh.HasTextureCoords(0))
        coordinates.push_back({mesh.mTextureCoords[0][at].x, mesh.mTextureCoords[0][at].y});
    }
    for (const Vec& corner : corners)
      base::require(max_abs(corner) <= MAX_NUMBER, path_,
                    "found a vertex at {:g} {:g} {:g}, expected coordinates up to {:g}", corner.x,
                    corner.y, corner.z, MAX_NUMBER);
    if (!std::ranges::all_of(coordinates, can_be_read)) {
      left_out_.add("texture coordinates beyond a million", "", coordinates.size());
      coordinates.clear();
    }
    if (!can_be_polygon(corners, normals)) normals.clear();
    if (can_be_polygon(corners, {}) && ++told_)
      target_.add_face(std::move(corners), std::move(normals), std::move(coordinates));
    else
      left_out_.add("triangles with area 0");
  }

  static bool can_be_read(const Corner& c) {
    return std::abs(c.u) <= MAX_COORDINATE && std::abs(c.v) <= MAX_COORDINATE;
  }

  static bool can_be_polygon(const std::vector<Vec>& corners, const std::vector<Vec>& normals) {
    try {
      check_polygon(corners, normals);
      return true;
    } catch (const base::BadInput&) {
      return false;
    }
  }

  const aiScene& scene_;
  const std::string& path_;
  ObjTarget& target_;
  LeftOut& left_out_;
  WordNames names_;       // unique names of materials
  std::size_t told_ = 0;  // number of faces sent to the target
};

}  // namespace

void read_mesh(const std::string& path, ObjTarget& target, LeftOut& left_out) {
  Assimp::Importer importer;
  importer.SetIOHandler(new RememberedFiles);  // owned by the importer
  const aiScene* scene = importer.ReadFile(
      path, aiProcess_Triangulate | aiProcess_SortByPType | aiProcess_PreTransformVertices);
  if (!scene || scene->mNumMeshes == 0) {
    const std::string reason = importer.GetErrorString();
    const auto has = [&](const char* word) { return reason.find(word) != reason.npos; };
    throw base::BadInput(fmt::format(
        "{}: found {}, expected a mesh of triangles", path,
        has("bad_alloc")            ? "a file that needs more memory than is available"
        : has("No suitable reader") ? "a file whose content does not fit the ending of its name"
        : reason.empty()            ? "none"
                                    : fmt::format("\"{}\"", base::blank_controls(reason))));
  }
  Teller(*scene, path, target, left_out).tell();
}

}  // namespace renderer
