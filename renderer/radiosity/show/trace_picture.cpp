// trace_picture(): the second pass.

#include <fmt/format.h>

#include <stdexcept>

#include "renderer/radiosity/show/locate.hpp"
#include "renderer/radiosity/show/picture.hpp"
#include "renderer/trace/shade.hpp"

namespace radiosity {

using renderer::Op;
using renderer::Work;

namespace {

constexpr int MAX_SAMPLES = 64, MAX_DEPTH = 1000;

renderer::Params make_params(const PictureParams& params) {
  renderer::Params made;
  made.width = params.width;
  made.height = params.height;
  made.sample = renderer::SamplePosition::center;
  return made;
}

// What the rays of a picture need.
struct Tracer {
  const Mesh& mesh;
  const Illumination& illumination;
  const Sides sides;
  const int depth;
  Work& work;

  std::optional<renderer::Hit> meet(const renderer::Ray& ray) {
    return intersect(mesh.blockers, ray, renderer::Traversal::nearest, work);
  }

  // What the ray meets, and whether there is something on that side of it. Another face may lie
  // where the first shows nothing, as two faces back to back do: looked for a little further on.
  std::optional<renderer::Hit> meet_side(const renderer::Ray& ray) {
    const auto is_nothing = [&](const renderer::Hit& hit) {
      return get_side(sides, hit.object, hit.inside).kind == Sides::Kind::nothing;
    };
    auto hit = meet(ray);
    if (!hit || !is_nothing(*hit)) return hit;
    renderer::Ray behind = ray;
    behind.from = hit->object;
    behind.reach = hit->distance + 10 * mesh.blockers.epsilon;
    hit = meet(behind);
    return hit && !is_nothing(*hit) ? hit : std::nullopt;
  }

  Rgb trace(renderer::Ray ray) {
    work[Op::sample_updated] += 1;
    for (int mirrors = 0;; ++mirrors) {
      const auto hit = meet_side(ray);
      if (!hit) return {};
      const Sides::Side& side = get_side(sides, hit->object, hit->inside);
      if (side.kind == Sides::Kind::patches) {
        const Spot spot = locate(mesh, side, hit->object, hit->point, work);
        return ray.influence * eval_illumination(illumination, spot.patch, spot.s, spot.t);
      }
      if (mirrors == depth) return {};
      work[Op::ray_reflected] += 1;
      ray.influence =
          ray.influence * mesh.materials[mesh.mirrors[side.mirror].material].reflectance;
      ray.origin = hit->point;
      ray.direction = normalize(ray.direction - 2 * dot(ray.direction, hit->normal) * hit->normal);
      ray.from = hit->object;
      ray.kind = renderer::RayKind::reflected;
    }
  }
};

}  // namespace

void check(const PictureParams& params) {
  const auto require = [](bool holds, const char* field, int found, int least, int most) {
    if (!holds)
      throw std::invalid_argument(
          fmt::format("{}: found {}, expected {} to {}", field, found, least, most));
  };
  check(make_params(params));
  require(params.samples >= 1 && params.samples <= MAX_SAMPLES, "pixel samples", params.samples, 1,
          MAX_SAMPLES);
  require(params.depth >= 0 && params.depth <= MAX_DEPTH, "picture depth", params.depth, 0,
          MAX_DEPTH);
}

renderer::View make_image_plane(const renderer::View& view) {
  renderer::Scene scene;
  scene.view = view;
  finish(scene);
  return scene.view;
}

Picture trace_picture(const Mesh& mesh, const Illumination& illumination,
                      const renderer::View& view, const PictureParams& params, Work& work) {
  check(params);
  renderer::Scene eye;
  eye.view = make_image_plane(view);
  const int n = params.samples;
  renderer::Params fine = make_params(params);
  fine.width *= n;
  fine.height *= n;
  Tracer tracer{mesh, illumination, make_sides(mesh), params.depth, work};
  Picture picture{params.width, params.height, {}};
  for (int y = 0; y < params.height; ++y)
    for (int x = 0; x < params.width; ++x) {
      Rgb sum;
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i)
          sum += tracer.trace(make_primary(eye, fine, n * x + i, n * y + j));
      picture.pixels.push_back((1.0 / (n * n)) * sum);
    }
  return picture;
}

}  // namespace radiosity
