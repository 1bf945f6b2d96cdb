#pragma once
// Comparison of two picture files.
#include <string>

#include "renderer/quality/quality.hpp"

namespace laboratory {

/// True if `path` has the extension of a picture file, .png or .exr, and is not a folder.
bool is_image(const std::string& path);

/// Two pictures of equal size and kind.
struct ImagePair {
  std::string names[2];
  bool is_linear = false;         ///< true: OpenEXR; false: PNG, whose bytes 0..255 are 0..1 here
  renderer::Picture pictures[2];  ///< the first is the reference
  renderer::PictureDifference difference;
  /// Structural similarity (see renderer::ssim()). Of OpenEXR, of bytes with gamma 2.2 and the
  /// exposure that makes 1 % of the reference's pixels white.
  double ssim = 1;
};

/// Throws BadInput for unreadable files, files of different kinds, and pictures of different sizes.
ImagePair compare_images(const std::string& reference, const std::string& other);

std::string to_text(const ImagePair& pair);

/// Writes a picture of the absolute differences. In a .png file they are multiplied so that the
/// largest becomes white; in an .exr file they are not. Returns the factor.
double save_difference(const std::string& path, const ImagePair& pair);

}  // namespace laboratory
