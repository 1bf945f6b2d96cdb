#pragma once
// The second pass: a picture of a lit room (thesis, 1.2.3 and 3.2.4).

#include "renderer/radiosity/light/solve.hpp"
#include "renderer/radiosity/show/reconstruct.hpp"

namespace radiosity {

/// Linear colours; rows run from the top.
struct Picture {
  int width = 0, height = 0;
  std::vector<Rgb> pixels;  ///< at y * width + x
  bool operator==(const Picture&) const = default;
};

struct PictureParams {
  int width = 0, height = 0;  ///< pixels, 1..65536 each and 2^28 together; 0: the view's
  int samples = 1;  ///< rays along and across a pixel, in a regular grid, 1..64; 1: its centre
  int depth = 8;    ///< maximum number of mirrors on a ray, 0..1000
};

/// The fields width, height, pixel_samples and depth.
base::Fields<PictureParams> picture_fields();
/// BadInput with the field, the value found and the values expected.
void check(const PictureParams& params);

/// `params` with the view's width and height if they are 0. Throws as check().
PictureParams fit(PictureParams params, const renderer::View& view);

/// The simplified ray tracer: a ray is reflected by mirrors and gets the illumination of the first
/// diffuse patch; no feelers, no shading. It is black if it hits nothing, a back, or a mirror after
/// `depth` others. Throws as check() and renderer::make_image_plane(). Adds to `work` one
/// Op::sample_updated for each ray from the eye and one Op::ray_reflected for each mirror.
Picture trace_picture(const Mesh& mesh, const Illumination& illumination,
                      const renderer::View& view, const PictureParams& params,
                      renderer::Work& work);

/// The picture of a lit room, without its work.
Picture trace_picture(const LitRoom& lit, const ReconstructionParams& reconstruction,
                      const renderer::View& view, const PictureParams& params);

/// By patch, the fraction of the picture's pixels that show it, each times the squared influence
/// factor after mirrors: the weight of the patch's mean square in that of the picture. Samples the
/// pixels' centres. Throws as trace_picture().
std::vector<Rgb> find_shares(const Mesh& mesh, const renderer::View& view,
                             const PictureParams& params);

/// For each pixel, true if it shows an emitter, in a mirror too.
std::vector<bool> find_emitters(const Mesh& mesh, const renderer::View& view,
                                const PictureParams& params);

/// The picture from a z-buffer, with one sample a pixel. Mirrors have the room's mean grey. Without
/// mirrors it equals trace_picture() except at the edges of faces, if patches are parallelograms;
/// in others (s, t) is linear in each of two triangles.
Picture preview_picture(const Mesh& mesh, const Illumination& illumination,
                        const renderer::View& view, const PictureParams& params);

}  // namespace radiosity
