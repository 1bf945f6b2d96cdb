// preview_picture(): what a z-buffer shows.

#include "renderer/radiosity/show/picture.hpp"
#include "renderer/radiosity/show/z_buffer.hpp"

namespace radiosity {

namespace {

// Of the patches, by area.
Rgb make_grey(const Mesh& mesh, const Illumination& illumination) {
  double sum = 0, area = 0;
  for (std::uint32_t i = 0; i < mesh.patches.size(); ++i) {
    const Rgb middle = eval_illumination(illumination, i, 0.5, 0.5);
    sum += mesh.patches[i].area * (middle.r + middle.g + middle.b) / 3;
    area += mesh.patches[i].area;
  }
  const double grey = area > 0 ? sum / area : 0;
  return {grey, grey, grey};
}

}  // namespace

Picture preview_picture(const Mesh& mesh, const Illumination& illumination,
                        const renderer::View& view, const PictureParams& params) {
  using Kind = Fragment::Kind;
  check(params);
  const renderer::View eye = make_image_plane(view);
  ZBuffer buffer(eye, params.width, params.height);
  const auto side = [&](const Vec& normal, const Vec& corner, Kind front) {
    return dot(normal, eye.from - corner) > 0 ? front : Kind::back;
  };
  for (std::uint32_t i = 0; i < mesh.patches.size(); ++i) {
    const Patch& patch = mesh.patches[i];
    std::array<ZBuffer::Point, 4> points = {{{{}, 0, 0}, {{}, 1, 0}, {{}, 1, 1}, {{}, 0, 1}}};
    for (std::size_t k = 0; k < 4; ++k) points[k].at = mesh.vertices[patch.corners[k]].at;
    buffer.draw(side(patch.normal, points[0].at, Kind::patch), i, points);
  }
  for (const Mirror& mirror : mesh.mirrors) {
    std::vector<ZBuffer::Point> points;
    for (const Vec& corner : mirror.corners) points.push_back({corner});
    buffer.draw(side(mirror.normal, points[0].at, Kind::mirror), 0, points);
  }
  const Rgb grey = make_grey(mesh, illumination);
  Picture picture{params.width, params.height, {}};
  for (const Fragment& f : buffer.fragments())
    picture.pixels.push_back(f.kind == Kind::patch
                                 ? eval_illumination(illumination, f.patch, f.s, f.t)
                             : f.kind == Kind::mirror ? grey
                                                      : Rgb{});
  return picture;
}

}  // namespace radiosity
