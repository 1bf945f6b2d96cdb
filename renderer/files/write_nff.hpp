#pragma once
// Writes NFF from which read_nff restores all numbers bit for bit.

#include <set>
#include <string>

#include "renderer/files/nff.hpp"

namespace renderer {

/// Converts names to words without blanks. Different names give different words.
class WordNames {
 public:
  std::string make(std::string name);

 private:
  std::set<std::string> made_;
};

class NffText : public NffTarget {
 public:
  /// Makes NFF text with picture paths relative to `folder`. The member functions throw BadInput
  /// for invalid polygons, and for picture paths that NFF cannot express: those that contain blanks
  /// or '#', or no full stop.
  explicit NffText(std::string folder) : folder_(std::move(folder)) {}

  /// The complete text: view, background and lights first, then the other statements in the order
  /// of the calls.
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
  std::vector<std::string> pictures_;  // path of each texture's picture, by index
  std::vector<Corner> coordinates_;    // texture coordinates of the next polygon
};

// Formats a view or light as the words of an NFF statement, without a '#' before them.
std::string describe_view(const View& view);
std::string describe_light(const Light& light, const std::optional<Rgb>& colour);
/// Formats "X Y Z" or "R G B" so that reading restores the numbers bit for bit.
std::string describe(const Vec& v);
std::string describe(const Rgb& colour);
/// Throws BadInput for a name that contains blanks or '#', which would end a word in NFF.
void check_word(const std::string& name);
/// Returns the path of `file` relative to `folder`. Throws BadInput as check_word() does.
std::string find_from(const std::string& folder, const std::string& file);

}  // namespace renderer
