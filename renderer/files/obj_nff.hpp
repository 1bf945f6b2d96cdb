#pragma once
// Translates OBJ statements to NFF statements, and back. The surface of an NFF file corresponds to
// a material whose model `illum` has reflected and refracted rays (3, 5 or 6):
//
//   f R G B KD KS SHINE T IOR  =  Kd KD*R KD*G KD*B   Ks KS KS KS   Ns SHINE   Tr T   Ni IOR
//
// If Ks is coloured, KS is its greatest component. A material with `illum` below 3 gets KS 0,
// because every NFF surface with highlights is also a mirror. A surface that only reflects (KS 1,
// KD 0) gets `illum` 3, which marks a mirror of a room; other reflecting surfaces get 5. Pictures
// (map_Kd) become textures with texture coordinates at the corners.

#include "renderer/files/nff.hpp"
#include "renderer/files/obj.hpp"
#include "renderer/files/text/left_out.hpp"

namespace renderer {

/// Adapter that forwards the content of an OBJ file to an NffTarget. Splits faces that are not flat
/// into triangles.
class ObjAsNff : public ObjTarget {
 public:
  /// `left_out` counts properties that NFF cannot express, such as coloured mirrors.
  ObjAsNff(NffTarget& target, LeftOut& left_out) : target_(target), left_out_(left_out) {}
  /// Completes the scene; to be called after the last statement. If the file has no view, adds a
  /// view from a point outside the objects. If it has no light either, also adds a light at the
  /// eye.
  void finish();

  void add_library(const std::string& path) override { target_.add_file(path); }
  void add_material(const MtlMaterial& material) override;
  void use_material(std::size_t material) override { material_ = material; }
  /// Throws BadInput if neither the face nor any triangle of it is a valid polygon.
  void add_face(std::vector<Vec> corners, std::vector<Vec> normals,
                std::vector<Corner> coordinates) override;
  void set_view(const View& view) override;
  void set_background(const Rgb& colour) override;
  void add_light(const Light& light, const std::optional<Rgb>& colour) override;

 private:
  struct Look {
    Surface surface;
    Rgb emission;
  };
  // A material, used with or without its picture.
  struct Use {
    std::size_t material;
    bool has_picture;
    bool operator==(const Use&) const = default;
  };

  void add_polygon(ObjFace face);
  void use_look(bool has_coordinates);

  NffTarget& target_;
  LeftOut& left_out_;
  std::vector<Look> looks_;   // appearance of each material, by index
  std::size_t material_ = 0;  // material of the next faces
  std::optional<Use> used_;   // material of the target's current surface
  Bounds bounds_;
  bool has_view_ = false, has_light_ = false;
};

/// Adapter that forwards the content of an NFF file to an ObjTarget. Counts parts that OBJ cannot
/// express, such as spheres, cones and gloss.
class NffAsObj : public NffTarget {
 public:
  NffAsObj(ObjTarget& target, LeftOut& left_out) : target_(target), left_out_(left_out) {}

  Knows knows() const override { return Knows::both; }
  void set_view(const View& view) override { target_.set_view(view); }
  void set_background(const Rgb& colour) override { target_.set_background(colour); }
  void add_light(const Light& light, const std::optional<Rgb>& colour) override {
    target_.add_light(light, colour);
  }
  void set_surface(const Surface& surface) override;
  void change_surface(const Surface& surface) override;
  void set_emission(const Rgb& emission) override {
    next_.emission = emission;
    is_new_ = true;
  }
  void set_lens(const Lens&) override { left_out_.add("lenses"); }
  void set_shutter(const Shutter&) override { left_out_.add("shutters"); }
  void set_motion(Motion) override { left_out_.add("motions"); }
  void set_camera(Path) override { left_out_.add("camera paths"); }
  std::uint32_t add_texture(const std::string& file, const Mapping& mapping) override;
  void set_coordinates(std::vector<Corner> coordinates) override {
    coordinates_ = std::move(coordinates);
  }
  void add_sphere(const Vec&, double) override { left_out_.add("spheres"); }
  void add_polygon(std::vector<Vec> corners, std::vector<Vec> normals) override;
  void add_cone(const Vec&, double, const Vec&, double) override { left_out_.add("cones"); }

 private:
  void use_next();

  ObjTarget& target_;
  LeftOut& left_out_;
  Surface surface_;     // surface of the latest NFF statement 'f'
  MtlMaterial next_;    // material of the next faces
  bool is_new_ = true;  // `next_` has not yet been selected in the target
  std::vector<MtlMaterial> materials_;
  std::vector<std::string> pictures_;  // picture file of each texture, by index
  std::vector<Corner> coordinates_;    // texture coordinates of the next polygon
};

}  // namespace renderer
