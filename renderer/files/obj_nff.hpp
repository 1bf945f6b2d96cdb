#pragma once
// Translates OBJ to NFF statements and NFF to OBJ statements. A surface becomes a material with
// reflected and refracted rays, `illum` 3, 5 or 6:
//
//   f R G B KD KS SHINE T IOR  =  Kd KD*R KD*G KD*B   Ks KS KS KS   Ns SHINE   Tr T   Ni IOR
//
// KS is the greatest component of a coloured Ks. A material with `illum` below 3 gets KS 0, because
// NFF has no highlights without mirror images. A surface that only mirrors (KS 1, KD 0) gets
// `illum` 3, the mirror of a room; other mirrors get 5. Pictures (map_Kd) become textures by
// coordinates.

#include "renderer/files/nff.hpp"
#include "renderer/files/obj.hpp"
#include "renderer/files/text/left_out.hpp"

namespace renderer {

/// Adapter that forwards an OBJ file to an NffTarget. Faces that are not flat become triangles.
class ObjAsNff : public ObjTarget {
 public:
  /// `left_out` counts what NFF cannot express, such as coloured mirrors.
  ObjAsNff(NffTarget& target, LeftOut& left_out) : target_(target), left_out_(left_out) {}
  /// Completes the scene after the last statement. If the file has no view, adds one from outside
  /// the objects. If it has neither view nor lights, also adds a light at the eye.
  void finish();

  void add_library(const std::string& path) override { target_.add_file(path); }
  void add_material(const MtlMaterial& material) override;
  void use_material(std::size_t material) override { material_ = material; }
  /// Throws BadInput if no part of the face is a valid polygon.
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
  // A material with or without its picture.
  struct Use {
    std::size_t material;
    bool has_picture;
    bool operator==(const Use&) const = default;
  };

  void add_polygon(ObjFace face);
  void use_look(bool has_coordinates);

  NffTarget& target_;
  LeftOut& left_out_;
  std::vector<Look> looks_;   // appearance of each material
  std::size_t material_ = 0;  // material of the next faces
  std::optional<Use> used_;   // current surface of the target
  Bounds bounds_;
  bool has_view_ = false, has_light_ = false;
};

/// Adapter that forwards an NFF file to an ObjTarget. Counts what OBJ cannot express: spheres,
/// cones, gloss and the like.
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
  Surface surface_;     // surface set by the latest NFF statement
  MtlMaterial next_;    // material of the next faces
  bool is_new_ = true;  // true if `next_` has not been added to the target
  std::vector<MtlMaterial> materials_;
  std::vector<std::string> pictures_;  // picture file of each texture
  std::vector<Corner> coordinates_;    // texture coordinates of the next polygon
};

}  // namespace renderer
