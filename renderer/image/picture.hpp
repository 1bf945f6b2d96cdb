#pragma once
// Pictures with linear colours, and OpenEXR files.

#include "renderer/image/image.hpp"

namespace renderer {

/// A picture with linear colours, not limited to a range; rows run from the top.
struct Picture {
  int width = 0, height = 0;
  std::vector<Rgb> pixels;  ///< at y * width + x
  bool operator==(const Picture&) const = default;
};

Picture make_picture(const Samples& samples);
/// Converts bytes to colours: 0..255 become 0..1.
Picture make_picture(const Bitmap& bitmap);

/// Returns the difference |a - b| multiplied by `factor`, for each colour component. Throws
/// BadInput if the sizes differ.
Picture make_difference(const Picture& a, const Picture& b, double factor = 1);

/// Writes an uncompressed OpenEXR file with linear R, G and B as 32-bit floats, rows from the top.
/// The bytes depend only on the picture. Throws BadInput for a picture without pixels, and the
/// errors of base::save_whole.
void save_exr(const std::string& path, const Picture& picture);
/// Loads the channels R, G and B of an OpenEXR file. Throws BadInput with the file's name if the
/// file cannot be read, is not a complete OpenEXR picture, lacks one of these channels, has more
/// than MAX_PICTURE pixels, or has a value that is infinite or not a number.
Picture load_exr(const std::string& path);

}  // namespace renderer
