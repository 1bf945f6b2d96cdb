#pragma once
// Second pass of radiosity: a picture of a lit room (thesis, 1.2.3 and 3.2.4).

#include "renderer/radiosity/light/solve.hpp"
#include "renderer/radiosity/show/reconstruct.hpp"

namespace radiosity {

/// Linear colours; rows run from the top.
struct Picture {
  int width = 0, height = 0;
  std::vector<Rgb> pixels;  ///< colours of the pixels, at y * width + x
  bool operator==(const Picture&) const = default;
};

struct PictureParams {
  int width = 0, height = 0;  ///< pixels, 1..65536 each and 2^28 together; 0: those of the view
  int samples = 1;  ///< rays along and across a pixel, in a regular grid, 1..64; 1: its centre
  int depth = 8;    ///< limit on the mirrors along a ray, 0..1000
};

/// Makes the fields width, height, pixel_samples and depth.
base::Fields<PictureParams> picture_fields();
/// Throws BadInput with the field, the value found and the values expected.
void check(const PictureParams& params);

/// Replaces width and height by those of the view if they are 0. Throws as check() does.
PictureParams fit(PictureParams params, const renderer::View& view);

/// Makes a picture by simplified ray tracing. A ray is reflected by mirrors until it meets a
/// diffuse patch, and has the illumination there, without feelers and shading. A ray is black if it
/// meets nothing, a back, or a mirror after `depth` others. Throws as check() and
/// renderer::make_image_plane() do. Adds to `work` one Op::sample_updated for each ray from the
/// eye, and one Op::ray_reflected for each mirror.
Picture trace_picture(const Mesh& mesh, const Illumination& illumination,
                      const renderer::View& view, const PictureParams& params,
                      renderer::Work& work);

/// Makes the picture of a lit room, without counting its work.
Picture trace_picture(const LitRoom& lit, const ReconstructionParams& reconstruction,
                      const renderer::View& view, const PictureParams& params);

/// For each patch, the weight of its mean square radiosity in the mean square of the picture: the
/// fraction of pixels that show the patch, each pixel multiplied by the squared influence factor
/// after mirrors. Samples the centres of pixels. Throws as trace_picture() does.
std::vector<Rgb> find_shares(const Mesh& mesh, const renderer::View& view,
                             const PictureParams& params);

/// For each pixel, true if it shows an emitter, directly or in a mirror.
std::vector<bool> find_emitters(const Mesh& mesh, const renderer::View& view,
                                const PictureParams& params);

/// Makes a picture by z-buffer, with one sample per pixel. Mirrors are shown in the mean grey of
/// the room. Without mirrors and with parallelograms as patches, it equals trace_picture() except
/// at the edges of faces. Other patches are cut into two triangles in which s and t are linear.
Picture preview_picture(const Mesh& mesh, const Illumination& illumination,
                        const renderer::View& view, const PictureParams& params);

}  // namespace radiosity
