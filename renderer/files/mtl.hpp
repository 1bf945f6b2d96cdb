#pragma once
// Reader of materials from Wavefront MTL files, the libraries of OBJ files.
//
// The reader uses newmtl, Kd, Ks, Ke, Ns, d, Tr, Ni, illum, and map_Kd with its options -o and -s.
// It skips Ka, sharpness, map_aat, and the keys of physically based rendering (Pr, Pm, ...). It
// leaves out and counts all others. Names of statements may have any case. A material's name is the
// rest of its line. A comment `# surface R G B KD` at the start of a line splits the preceding Kd
// into a colour and a factor, as NFF needs them. It is ignored unless R G B times KD equals that
// Kd.

#include <string>
#include <string_view>
#include <vector>

#include "renderer/files/text/left_out.hpp"
#include "renderer/scene/vec.hpp"

namespace renderer {

/// A material of an MTL file. By default it is black and opaque. Ranges are those of `f` in NFF.
struct MtlMaterial {
  std::string name{};
  Rgb diffuse{}, specular{}, emission{};  ///< Kd, Ks, Ke
  double shine = 0;                       ///< Ns, Phong exponent
  double transparency = 0;                ///< Tr if d is absent or agrees with it, else 1 - d
  double ior = 1;                         ///< Ni, index of refraction
  int illum = 2;                          ///< illumination model; 3 and above have reflected rays
  std::string picture{};                  ///< map_Kd, path of an existing PNG file; may be empty
  Rgb colour{1, 1, 1};                    ///< colour whose product with kd is `diffuse`
  double kd = 0;
  bool operator==(const MtlMaterial&) const = default;

  /// Sets `diffuse` to the product of a colour and a factor, and keeps both in `colour` and `kd`.
  void set_diffuse(const Rgb& of, double factor) {
    colour = of, kd = factor, diffuse = factor * of;
  }
  /// Sets `diffuse` to a colour with the factor 1. Black becomes white with the factor 0.
  void set_diffuse(const Rgb& rgb) {
    rgb == Rgb{} ? set_diffuse({1, 1, 1}, 0) : set_diffuse(rgb, 1);
  }
};
inline constexpr int ILLUM_REFLECTS = 3, ILLUM_REFRACTS = 6;

/// Colour of faces without a material, and of materials without a colour.
inline constexpr Rgb LIGHT_GREY{0.8, 0.8, 0.8};

/// Linear map from the texture coordinates of a face to those of its picture.
struct PictureMap {
  double u_scale = 1, v_scale = 1, u_offset = 0, v_offset = 0;
  bool operator==(const PictureMap&) const = default;
};

/// A material as read, with the map of its picture.
struct MtlEntry {
  MtlMaterial material{};
  PictureMap map{};
  int line = 0;  ///< line of its newmtl
};

/// Reads a library. `left_out` counts unreadable values and missing pictures, which get their
/// defaults. A material without Kd is white if it has a picture. If it has none, it is light grey
/// unless it emits, reflects or transmits light. `Tr 1` without `d` means opaque if `illum` has no
/// transparency, because MeshLab writes it so. Throws BadInput for UTF-16.
std::vector<MtlEntry> read_mtl(std::string_view text, const std::string& path, LeftOut& left_out);

}  // namespace renderer
