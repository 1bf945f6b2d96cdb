#pragma once
// Scenes by name: made by a generator, or from E. Haines's Neutral File Format (SPD 3.x):
//
//   v  from X Y Z  at X Y Z  up X Y Z  angle DEGREES  [hither D]  [resolution W H]     required
//   b R G B                                            background, black by default
//   l X Y Z [R G B]                                    without a colour: 1 / sqrt(number of lights)
//   f R G B Kd Ks Shine T IOR                          surface of the primitives that follow it
//   s X Y Z R                                          sphere
//   p N  N x (X Y Z)                                   polygon, flat, concave or not
//   pp N  N x (X Y Z NX NY NZ)                         polygon with normals
//   c X Y Z R  X Y Z R                                 cone or cylinder, open: base and apex
//
// Words may be broken over lines anywhere; only a light's colour must be on the light's line. '#'
// starts a comment. A primitive before any `f` is an error, as is anything degenerate.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/scene/scene.hpp"

namespace renderer {

/// A generator with its number, such as "spheres:800" or "hills:20000", or the path of an .nff
/// file. BadInput as parse_nff(), if the file cannot be read, and for anything else, naming what is
/// valid.
Scene load_scene(const std::string& source);

/// Reads an NFF scene. BadInput "name:line: found ..., expected ...".
Scene parse_nff(std::string_view text, const std::string& name);

/// What is made of a file: it is told every statement, in the file's order. A BadInput that it
/// throws is reported with the statement's line.
class NffTarget {
 public:
  virtual ~NffTarget() = default;
  /// Whether `# emit R G B`, a comment in NFF, is a statement.
  virtual bool takes_emission() const { return false; }

  virtual void set_view(const View& view) = 0;
  virtual void set_background(const Rgb&) {}
  virtual void add_light(const Vec& at, const std::optional<Rgb>& colour) = 0;
  virtual void set_surface(const Surface& surface) = 0;
  virtual void set_emission(const Rgb&) {}
  virtual void add_sphere(const Vec& centre, double radius) = 0;
  /// As many normals as corners, or none.
  virtual void add_polygon(std::vector<Vec> corners, std::vector<Vec> normals) = 0;
  virtual void add_cone(const Vec& base, double base_radius, const Vec& apex,
                        double apex_radius) = 0;

  int line = 0;  ///< of the statement that is told
};

/// Tells `target` a text. BadInput "name:line: ..."; returns the line of the view.
int read_nff(std::string_view text, const std::string& name, NffTarget& target);

}  // namespace renderer
