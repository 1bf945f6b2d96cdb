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
// Statements may continue on further lines; only a light's colour must be on the light's line. '#'
// starts a comment. Primitives before any `f` and degenerate input are errors.
//
// Extensions to NFF are comments that begin a line, so that other readers skip them:
//
//   # lens APERTURE FOCUS                              diameter, and the distance in focus
//   # shutter T0 T1                                    when it opens and closes, frames
//   # move DX DY DZ                                    velocity of the objects that follow it,
//                                                      per frame
//   # path FILE                                        their displacement over time: T X Y Z
//   # camera FILE                                      the view over time: T FROM AT
//   # light rect X Y Z  UX UY UZ  VX VY VZ [R G B]     middle and two half edges
//   # light sphere X Y Z R [R G B]
//   # gloss S                                          of the surface of the objects that follow
//   # translucent S
//   # texture FILE planar O U V                        of the same surface; O is the picture's
//                                                      lower left corner, U and V its edges there
//   # texture FILE spherical X Y Z [axis AX AY AZ]     around a middle; axis 0 0 1 by default
//   # texture FILE mesh                                by coordinates:
//   # uv U V U V ...                                   a pair for each corner of the `p` or `pp`
//                                                      that follows; further lines add to it
//
// A comment is a statement if its first word is the name of a statement above and the next words
// have that statement's form: a number, a light's shape and a number, the name of a single file
// (.path, .csv or .txt), or the name of a picture (.png). The statement ends with its line. Other
// comments are prose.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/files/path.hpp"
#include "renderer/scene/scene.hpp"

namespace renderer {

/// Times at which the shutter opens and closes, in frames relative to the rendered frame.
struct Shutter {
  double open = 0, close = 0;
};

/// Motion of objects. The path gives the displacement at a time in frames. Without a path, the
/// displacement is time * velocity.
struct Motion {
  Vec velocity;  ///< velocity in scene units per frame
  Path path;
};

/// Receiver of the statements of an NFF file, in the order of the file. If a function throws
/// BadInput, the reader puts the line of the statement before its message.
class NffTarget {
 public:
  virtual ~NffTarget() = default;
  /// The kind of file that the target reads. Rooms have `# emit R G B`, and scenes have the other
  /// statements in comments. For a target of both kinds, `# emit` is prose unless a number follows.
  enum class Knows : std::uint8_t { scenes, rooms, both };
  virtual Knows knows() const { return Knows::scenes; }

  virtual void set_view(const View& view) = 0;
  virtual void set_background(const Rgb&) {}
  /// Adds a light with a colour, or with a default intensity if there is no colour.
  virtual void add_light(const Light& light, const std::optional<Rgb>& colour) = 0;
  virtual void set_surface(const Surface& surface) = 0;
  /// Sets the surface of the objects that follow.
  virtual void change_surface(const Surface&) {}
  virtual void set_emission(const Rgb&) {}
  virtual void set_lens(const Lens&) {}
  virtual void set_shutter(const Shutter&) {}
  /// Sets the motion of the objects that follow.
  virtual void set_motion(Motion) {}
  virtual void set_camera(Path) {}
  /// Adds a file that a statement refers to.
  virtual void add_file(const std::string&) {}
  /// Adds a texture and returns its index.
  virtual std::uint32_t add_texture(const std::string&, const Mapping&) { return NO_TEXTURE; }
  /// Sets the texture coordinates for the corners of the next polygon. The list is empty for a
  /// polygon without coordinates.
  virtual void set_coordinates(std::vector<Corner>) {}
  virtual void add_sphere(const Vec& centre, double radius) = 0;
  /// Adds a polygon with one normal for each corner, or with no normals.
  virtual void add_polygon(std::vector<Vec> corners, std::vector<Vec> normals) = 0;
  virtual void add_cone(const Vec& base, double base_radius, const Vec& apex,
                        double apex_radius) = 0;

  int line = 0;  ///< line of the current statement
};

/// Sends the statements of a text to `target`. The text must have a view. Throws BadInput
/// "name:line: ...".
void read_nff(std::string_view text, const std::string& name, NffTarget& target);

}  // namespace renderer
