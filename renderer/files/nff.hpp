#pragma once
// E. Haines's Neutral File Format (SPD 3.x):
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
//
// What NFF has no word for is said in comments that begin a line, so that other readers pass over
// it:
//
//   # lens APERTURE FOCUS                              diameter, and the distance in focus
//   # shutter T0 T1                                    when it opens and closes, frames
//   # move DX DY DZ                                    velocity of the objects that follow it, a
//                                                      frame
//   # path FILE                                        their displacement over time: T X Y Z
//   # camera FILE                                      the view over time: T FROM AT
//   # light rect X Y Z  UX UY UZ  VX VY VZ [R G B]     middle and two half edges
//   # light sphere X Y Z R [R G B]
//   # gloss S                                          of the surface of the objects that follow
//   # translucent S
//   # texture FILE planar O U V                        of the same surface; from point O, a picture
//                                                      goes as far as edges U and V
//   # texture FILE spherical X Y Z [axis AX AY AZ]     around a middle; axis 0 0 1 by default
//   # texture FILE mesh                                by coordinates:
//   # uv U V U V ...                                   a pair for each corner of the `p` or `pp`
//                                                      that follows; further lines add to it
//
// A comment is a statement if its first word is a statement's name and what follows begins as
// above: with a number, with the one name of a file that ends in .path, .csv or .txt, with that of
// a picture, which ends in .png, or with a light's shape and a number. It ends with its line. Any
// other comment is prose.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/files/path.hpp"
#include "renderer/scene/scene.hpp"

namespace renderer {

/// When the shutter opens and closes, in frames after the frame's own time.
struct Shutter {
  double open = 0, close = 0;
};

/// How objects move: their displacement at a time, in frames, is time * velocity, or as the path
/// has it if there is one.
struct Motion {
  Vec velocity;  ///< scene units a frame
  Path path;
};

/// What is made of a file: it is told every statement, in the file's order. A BadInput that it
/// throws is reported with the statement's line.
class NffTarget {
 public:
  virtual ~NffTarget() = default;
  /// Whether it knows rooms, which have `# emit R G B`, and scenes, which have the other statements
  /// in comments. One that knows both takes `# emit` for prose where no number follows.
  enum class Knows : std::uint8_t { scenes, rooms, both };
  virtual Knows knows() const { return Knows::scenes; }

  virtual void set_view(const View& view) = 0;
  virtual void set_background(const Rgb&) {}
  /// Without its colour.
  virtual void add_light(const Light& light, const std::optional<Rgb>& colour) = 0;
  virtual void set_surface(const Surface& surface) = 0;
  /// What the surface set last is from here on.
  virtual void change_surface(const Surface&) {}
  virtual void set_emission(const Rgb&) {}
  virtual void set_lens(const Lens&) {}
  virtual void set_shutter(const Shutter&) {}
  /// Of the objects that follow.
  virtual void set_motion(Motion) {}
  virtual void set_camera(Path) {}
  /// A further file that is read for the statement.
  virtual void add_file(const std::string&) {}
  /// Returns the texture's index.
  virtual std::uint32_t add_texture(const std::string&, const Mapping&) { return NO_TEXTURE; }
  /// Of the corners of the polygon that is told next; none: it has none.
  virtual void set_coordinates(std::vector<Corner>) {}
  virtual void add_sphere(const Vec& centre, double radius) = 0;
  /// As many normals as corners, or none.
  virtual void add_polygon(std::vector<Vec> corners, std::vector<Vec> normals) = 0;
  virtual void add_cone(const Vec& base, double base_radius, const Vec& apex,
                        double apex_radius) = 0;

  int line = 0;  ///< of the statement that is told
};

/// Tells `target` a text, which has a view. BadInput "name:line: ...".
void read_nff(std::string_view text, const std::string& name, NffTarget& target);

}  // namespace renderer
