#pragma once
// Reader of Wavefront MTL files, the libraries of materials for OBJ files.
//
// The reader uses newmtl, Kd, Ks, Ke, Ns, d, Tr, Ni, illum, and map_Kd with its options -o and -s.
// It skips Ka, sharpness, map_aat, and the keys of physically based rendering (Pr, Pm, ...). It
// ignores all other statements, but counts them. Upper and lower case are the same in statements.
// The name of a material is the rest of its line.
//
// A comment `# surface R G B KD` at the start of a line splits the preceding Kd into a colour and a
// factor, as NFF states them. The comment is ignored unless R G B times KD equals that Kd.

#include <string>
#include <string_view>
#include <vector>

#include "renderer/files/text/left_out.hpp"
#include "renderer/scene/vec.hpp"

namespace renderer {

/// A material of an MTL file, by default black and opaque. Its numbers have the same limits as
/// those of the NFF statement `f`.
struct MtlMaterial {
  std::string name{};
  Rgb diffuse{}, specular{}, emission{};  ///< from the statements Kd, Ks and Ke
  double shine = 0;                       ///< from the statement Ns; the Phong exponent
  double transparency = 0;                ///< Tr if d is absent or equals 1 - Tr, else 1 - d
  double ior = 1;                         ///< from the statement Ni; the index of refraction
  int illum = 2;          ///< illumination model; 3 and higher models have reflected rays
  std::string picture{};  ///< from map_Kd; path of an existing PNG file, "" if none
  Rgb colour{1, 1, 1};    ///< `diffuse` is the product of `colour` and `kd`
  double kd = 0;
  bool operator==(const MtlMaterial&) const = default;

  /// Sets `colour` and `kd` to the given values, and `diffuse` to their product.
  void set_diffuse(const Rgb& of, double factor) {
    colour = of, kd = factor, diffuse = factor * of;
  }
  /// Sets `diffuse` and `colour` to the same colour, with `kd` 1. For black, `colour` is white and
  /// `kd` is 0.
  void set_diffuse(const Rgb& rgb) {
    rgb == Rgb{} ? set_diffuse({1, 1, 1}, 0) : set_diffuse(rgb, 1);
  }
};
inline constexpr int ILLUM_REFLECTS = 3, ILLUM_REFRACTS = 6;

/// Colour of faces without a material, and of materials for which the file gives no colour.
inline constexpr Rgb LIGHT_GREY{0.8, 0.8, 0.8};

/// Linear map from a face's texture coordinates (u, v) to coordinates of its picture, 0 to 1.
struct PictureMap {
  double u_scale = 1, v_scale = 1, u_offset = 0, v_offset = 0;
  bool operator==(const PictureMap&) const = default;
};

/// A material read from a file, with the map of its picture's coordinates.
struct MtlEntry {
  MtlMaterial material{};
  PictureMap map{};
  int line = 0;  ///< line of the newmtl statement, counted from 1
};

/// Reads a library of materials. Unreadable values and missing pictures get their defaults, and
/// `left_out` counts them. A material without Kd is white if it has a picture. Without a picture,
/// it is light grey unless it emits, reflects or transmits light. `Tr 1` without `d` means opaque
/// if the model `illum` has no transparency, because MeshLab writes opaque materials this way.
/// `path` is the path of the library. Throws BadInput for a text in UTF-16.
std::vector<MtlEntry> read_mtl(std::string_view text, const std::string& path, LeftOut& left_out);

}  // namespace renderer
