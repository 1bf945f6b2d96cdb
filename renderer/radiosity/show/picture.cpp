#include "renderer/radiosity/show/picture.hpp"

#include "renderer/radiosity/show/locate.hpp"
#include "renderer/radiosity/show/z_buffer.hpp"
#include "renderer/scene/require.hpp"
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

// Traces the rays of a picture.
struct Tracer {
  const Mesh& mesh;
  const Illumination& illumination;
  const Sides sides;
  const int depth;
  Work& work;

  std::optional<renderer::Hit> meet(const renderer::Ray& ray) {
    return intersect(mesh.blockers, ray, renderer::Traversal::nearest, work);
  }

  // What the ray meets, if there is something on that side of it. Two faces may lie back to back:
  // where the first shows nothing, another is looked for a little further on.
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
      ray.direction = renderer::reflect(ray.direction, hit->normal);
      ray.from = hit->object;
      ray.kind = renderer::RayKind::reflected;
    }
  }
};

// The mean of the patches, by area.
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

void check(const PictureParams& params) {
  PictureParams sized = params;
  if (params.width == 0) sized.width = 1;
  if (params.height == 0) sized.height = 1;
  check(make_params(sized));
  using renderer::require;
  require(params.samples >= 1 && params.samples <= MAX_SAMPLES, "pixel samples", params.samples,
          fmt::format("1 to {}", MAX_SAMPLES));
  require(params.depth >= 0 && params.depth <= MAX_DEPTH, "picture depth", params.depth,
          fmt::format("0 to {}", MAX_DEPTH));
}

PictureParams fit(PictureParams params, const renderer::View& view) {
  if (params.width == 0) params.width = view.width;
  if (params.height == 0) params.height = view.height;
  check(params);
  return params;
}

Picture trace_picture(const Mesh& mesh, const Illumination& illumination,
                      const renderer::View& view, const PictureParams& asked, Work& work) {
  const PictureParams params = fit(asked, view);
  const renderer::View eye = make_image_plane(view);
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

Picture trace_picture(const LitRoom& lit, const ReconstructionParams& reconstruction,
                      const renderer::View& view, const PictureParams& params) {
  Work ignored;
  return trace_picture(lit.mesh, reconstruct(lit.mesh, lit.vertices, reconstruction), view, params,
                       ignored);
}

Picture preview_picture(const Mesh& mesh, const Illumination& illumination,
                        const renderer::View& view, const PictureParams& asked) {
  using Kind = Fragment::Kind;
  const PictureParams params = fit(asked, view);
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

std::vector<bool> find_emitters(const Mesh& mesh, const renderer::View& view,
                                const PictureParams& params) {
  std::vector<Rgb> emission;
  for (const Vertex& vertex : mesh.vertices)
    emission.push_back(mesh.materials[vertex.material].emission);
  Work ignored;
  const auto picture = trace_picture(mesh, reconstruct(mesh, emission, {Reconstruction::flat, {}}),
                                     view, params, ignored);
  std::vector<bool> emitters;
  for (const Rgb& pixel : picture.pixels) emitters.push_back(max_component(pixel) > 0);
  return emitters;
}

}  // namespace radiosity
