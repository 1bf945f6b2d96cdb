#pragma once
// The second pass of radiosity: makes a picture of a room with computed light (thesis, 1.2.3 and
// 3.2.4).

#include "renderer/image/picture.hpp"
#include "renderer/radiosity/light/solve.hpp"
#include "renderer/radiosity/show/reconstruct.hpp"

namespace radiosity {

using renderer::Picture;

struct PictureParams {
  /// Size in pixels, 1..65536 each, product at most 2^28; 0: the size of the view.
  int width = 0, height = 0;
  int samples = 1;  ///< rays along and across a pixel, in a regular grid, 1..64; 1: the centre only
  int depth = 8;    ///< limit on the number of mirrors along a ray, 0..1000
};

/// Makes the fields width, height, pixel_samples and depth.
base::Fields<PictureParams> picture_fields();
/// Throws BadInput with the name of the field, the value found and the values expected.
void check(const PictureParams& params);

/// Replaces a width and height of 0 by those of the view. Throws as check() does.
PictureParams fit(PictureParams params, const renderer::View& view);

/// Makes a picture by simplified ray tracing. A ray is reflected by mirrors until it meets a
/// diffuse patch. Its colour is the illumination there; no further rays are cast and no shading is
/// computed. A ray is black if it meets nothing, the back of a face, or a mirror after `depth`
/// other mirrors. Throws as check() and renderer::make_image_plane() do. Counts in `work` one
/// Op::sample_updated for each ray from the eye, and one Op::ray_reflected for each mirror.
Picture trace_picture(const Mesh& mesh, const Illumination& illumination,
                      const renderer::View& view, const PictureParams& params,
                      renderer::Work& work);

/// Makes the picture of a room with computed light, without counting work.
Picture trace_picture(const LitRoom& lit, const ReconstructionParams& reconstruction,
                      const renderer::View& view, const PictureParams& params);

/// Returns a weight for each patch: the fraction of pixels that show the patch, each multiplied by
/// the squared reflectance of the mirrors in between. The sum of the patches' mean square
/// radiosities with these weights is the mean square of the picture. Samples the centres of pixels.
/// Throws as trace_picture() does.
std::vector<Rgb> find_shares(const Mesh& mesh, const renderer::View& view,
                             const PictureParams& params);

/// By pixel: true if the pixel shows an emitter, directly or in a mirror.
std::vector<bool> find_emitters(const Mesh& mesh, const renderer::View& view,
                                const PictureParams& params);

/// Makes a picture by z-buffer, with one sample per pixel. Mirrors are shown in the mean grey of
/// the room. If the room has no mirrors and all patches are parallelograms, the picture equals that
/// of trace_picture() except at the edges of faces. Other patches are divided into two triangles in
/// which s and t are linear.
Picture preview_picture(const Mesh& mesh, const Illumination& illumination,
                        const renderer::View& view, const PictureParams& params);

}  // namespace radiosity
