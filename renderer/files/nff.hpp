#pragma once
// Reader of E. Haines's Neutral File Format (SPD 3.x). It has these statements:
//
//   v  from X Y Z  at X Y Z  up X Y Z  angle DEGREES  [hither D]  [resolution W H]     required
//   b R G B                        background colour, black by default
//   l X Y Z [R G B]                light; intensity 1 / sqrt(number of lights) without a colour
//   f R G B Kd Ks Shine T IOR      surface of the primitives that follow
//   s X Y Z R                      sphere
//   p N  N x (X Y Z)               flat polygon with N corners, convex or concave
//   pp N  N x (X Y Z NX NY NZ)     polygon with a normal at each corner
//   c X Y Z R  X Y Z R             cone or cylinder without end caps: base, then apex
//
// Statements may continue on further lines, but the colour of a light must be on the light's line.
// '#' starts a comment. Primitives before the first `f` and degenerate primitives are errors.
//
// Extensions to NFF are statements in comments that begin a line, so that other readers skip them:
//
//   # lens APERTURE FOCUS                              diameter; distance of the plane in focus
//   # shutter T0 T1                                    opening and closing times, in frames
//   # move DX DY DZ                                    velocity of the objects that follow,
//                                                      in scene units per frame
//   # path FILE                                        displacement of these objects over time;
//                                                      each line has T X Y Z
//   # camera FILE                                      view over time: T, FROM and AT points
//   # light rect X Y Z  UX UY UZ  VX VY VZ [R G B]     rectangle: centre and two half edges
//   # light sphere X Y Z R [R G B]
//   # gloss S                                          spread of reflected rays, for the surface
//                                                      of the objects that follow
//   # translucent S                                    spread of refracted rays, likewise
//   # texture FILE planar O U V                        texture of this surface; O is the point of
//                                                      the picture's lower left corner, and U and
//                                                      V are its edges
//   # texture FILE spherical X Y Z [axis AX AY AZ]     around a centre; axis 0 0 1 by default
//   # texture FILE mesh                                by the coordinates in '# uv'
//   # uv U V U V ...                                   a pair for each corner of the `p` or `pp`
//                                                      that follows; may take several lines
//
// A comment is a statement if its first word is the name of a statement above and the next words
// have the form of that statement: a number, the shape of a light and a number, the name of a
// single file (.path, .csv or .txt), or the name of a picture (.png). Such a statement ends with
// its line. All other comments are prose.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/files/path.hpp"
#include "renderer/scene/scene.hpp"

namespace renderer {

/// Times at which the shutter opens and closes, in frames after the start of the rendered frame.
struct Shutter {
  double open = 0, close = 0;
};

/// Motion of objects. The path gives the displacement, in scene units, at a time in frames. Without
/// a path, the displacement is the time multiplied by `velocity`.
struct Motion {
  Vec velocity;  ///< velocity in scene units per frame
  Path path;
};

/// Interface that receives the statements of an NFF file, in the order of the file. If a member
/// function throws BadInput, the reader puts the line of the statement before the message.
class NffTarget {
 public:
  virtual ~NffTarget() = default;
  /// The kind of file that the target reads. Files of rooms may contain `# emit R G B`; files of
  /// scenes may contain all other statements in comments. For `both`, `# emit` is prose unless a
  /// number follows.
  enum class Knows : std::uint8_t { scenes, rooms, both };
  virtual Knows knows() const { return Knows::scenes; }

  virtual void set_view(const View& view) = 0;
  virtual void set_background(const Rgb&) {}
  /// Adds a light. A light without a colour gets the default intensity.
  virtual void add_light(const Light& light, const std::optional<Rgb>& colour) = 0;
  virtual void set_surface(const Surface& surface) = 0;
  /// Changes the surface of the objects that follow, after a comment such as `# gloss`.
  virtual void change_surface(const Surface&) {}
  virtual void set_emission(const Rgb&) {}
  virtual void set_lens(const Lens&) {}
  virtual void set_shutter(const Shutter&) {}
  /// Sets the motion of the objects that follow.
  virtual void set_motion(Motion) {}
  virtual void set_camera(Path) {}
  /// Reports the name of another file that a statement names.
  virtual void add_file(const std::string&) {}
  /// Adds a texture and returns its index.
  virtual std::uint32_t add_texture(const std::string&, const Mapping&) { return NO_TEXTURE; }
  /// Sets the texture coordinates of the corners of the next polygon. An empty list means that the
  /// polygon has none.
  virtual void set_coordinates(std::vector<Corner>) {}
  virtual void add_sphere(const Vec& centre, double radius) = 0;
  /// Adds a polygon. `normals` has one normal for each corner, or is empty.
  virtual void add_polygon(std::vector<Vec> corners, std::vector<Vec> normals) = 0;
  virtual void add_cone(const Vec& base, double base_radius, const Vec& apex,
                        double apex_radius) = 0;

  int line = 0;  ///< line of the current statement, counted from 1
};

/// Calls a function of `target` for each statement of a text. The text must contain a view. `name`
/// is the file's path. Throws BadInput "name:line: ...".
void read_nff(std::string_view text, const std::string& name, NffTarget& target);

}  // namespace renderer
