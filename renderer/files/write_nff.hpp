#pragma once
// Writes NFF: what is told becomes text that read_nff() tells again, every number to the bit.

#include <string>

#include "renderer/files/nff.hpp"

namespace renderer {

class NffText : public NffTarget {
 public:
  /// Pictures are named as they are found from `folder`. BadInput from then on for polygons that
  /// are none, and for paths that NFF cannot have: with blanks or #, or without a full stop.
  explicit NffText(std::string folder) : folder_(std::move(folder)) {}

  /// View, background and lights, then the rest in the order that it was told.
  std::string text() const { return head_ + body_; }

  Knows knows() const override { return Knows::both; }
  void set_view(const View& view) override;
  void set_background(const Rgb& colour) override;
  void add_light(const Light& light, const std::optional<Rgb>& colour) override;
  void set_surface(const Surface& surface) override;
  void set_emission(const Rgb& emission) override;
  std::uint32_t add_texture(const std::string& file, const Mapping& mapping) override;
  void set_coordinates(std::vector<Corner> coordinates) override;
  void add_sphere(const Vec& centre, double radius) override;
  void add_polygon(std::vector<Vec> corners, std::vector<Vec> normals) override;
  void add_cone(const Vec& base, double base_radius, const Vec& apex, double apex_radius) override;

 private:
  std::string folder_, head_, body_;
  std::vector<std::string> pictures_;  // by texture
};

// What OBJ says in comments in the same words, without the '#'.
std::string describe_view(const View& view);
std::string describe_light(const Light& light, const std::optional<Rgb>& colour);
/// "X Y Z" and "R G B", which are read again to the bit.
std::string describe(const Vec& v);
std::string describe(const Rgb& colour);
/// BadInput if it has blanks or #, which would end it.
void check_word(const std::string& name);
/// How `file` is found from `folder`, by check_word().
std::string find_from(const std::string& folder, const std::string& file);

}  // namespace renderer
