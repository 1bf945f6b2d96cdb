#include "renderer/radiosity/show/picture.hpp"

#include "renderer/radiosity/show/locate.hpp"
#include "renderer/scan/scan.hpp"
#include "renderer/scene/require.hpp"
#include "renderer/trace/shade.hpp"

namespace radiosity {

using renderer::Op;
using renderer::Work;

namespace {

renderer::Params make_params(const PictureParams& params) {
  renderer::Params made;
  made.width = params.width;
  made.height = params.height;
  made.sample = renderer::SamplePosition::center;
  return made;
}

// The point of a patch that a ray meets, and the product of the reflectances of all mirrors before
// it.
struct Seen {
  Spot spot;
  Rgb influence;
};

// Traces the rays of a picture.
struct Tracer {
  const Mesh& mesh;
  const Sides sides;
  const int depth;
  Work& work;

  std::optional<renderer::Hit> meet(const renderer::Ray& ray) {
    return intersect(mesh.blockers, ray, renderer::Traversal::nearest, work);
  }

  // The first hit of the ray on a visible side. If the ray hits a side that is not visible, also
  // searches just behind this side, because two faces may lie back to back.
  std::optional<renderer::Hit> meet_side(const renderer::Ray& ray) {
    const auto is_nothing = [&](const renderer::Hit& hit) {
      return get_side(sides, hit.object, hit.inside).kind == Side::Kind::nothing;
    };
    auto hit = meet(ray);
    if (!hit || !is_nothing(*hit)) return hit;
    renderer::Ray behind = ray;
    behind.from = hit->object;
    behind.reach = hit->distance + 10 * mesh.blockers.epsilon;
    hit = meet(behind);
    return hit && !is_nothing(*hit) ? hit : std::nullopt;
  }

  std::optional<Seen> trace(renderer::Ray ray) {
    work[Op::sample_updated] += 1;
    for (int mirrors = 0;; ++mirrors) {
      const auto hit = meet_side(ray);
      if (!hit) return std::nullopt;
      const Side& side = get_side(sides, hit->object, hit->inside);
      if (side.kind == Side::Kind::patches)
        return Seen{locate(mesh, side, hit->object, hit->point, work), ray.influence};
      if (mirrors == depth) return std::nullopt;
      work[Op::ray_reflected] += 1;
      ray.influence = ray.influence * mesh.materials[side.material].reflectance;
      ray.origin = hit->point;
      ray.direction = renderer::reflect(ray.direction, hit->normal);
      ray.from = hit->object;
      ray.kind = renderer::RayKind::reflected;
    }
  }
};

// An entry of the z-buffer: the nearest surface found so far at a pixel.
struct Fragment {
  enum class Kind : std::uint8_t { nothing, back, patch, mirror };
  Kind kind = Kind::nothing;
  std::uint32_t patch = 0;
  double nearness = 0;  // 1 / depth; 0 if the pixel is empty
  double s = 0, t = 0;

  // Replaces this fragment by a nearer one. Of two fragments at the same depth, a front replaces a
  // back.
  void put(const Fragment& other) {
    // Relative difference in 1 / depth up to which fragments count as being at the same depth.
    constexpr double COINCIDENT = 1e-9;
    if (!(other.nearness > 0)) return;
    const bool over = kind == Kind::back && other.kind != Kind::back,
               under = other.kind == Kind::back && kind != Kind::back;
    const double worth = over ? 1 + COINCIDENT : under ? 1 - COINCIDENT : 1;
    if (other.nearness * worth > nearness) *this = other;
  }
};

// A z-buffer for convex polygons whose corners have parameters s and t. The view must have its
// image plane (see make_image_plane()).
class ZBuffer {
 public:
  struct Point {
    Vec at;
    double s = 0, t = 0;
  };

  ZBuffer(const renderer::View& view, const renderer::Params& params)
      : view_(view),
        width_(static_cast<std::size_t>(params.width)),
        scanner_(renderer::make_raster(view, params), renderer::get_area(params)),
        fragments_(width_ * static_cast<std::size_t>(params.height)) {}

  // Draws both sides of a convex polygon of at least 3 corners. At each pixel, the nearest polygon
  // stays. If several polygons are at the same depth, a patch or mirror hides backs of faces;
  // otherwise, the first polygon stays. The polygon is divided into triangles at its first corner;
  // in each of them, s and t are linear in space.
  void draw(Fragment::Kind kind, std::uint32_t patch, const std::vector<Point>& points) {
    const auto corner = [&](std::size_t i) -> renderer::Scanner<2>::Corner {
      return {renderer::to_eye(view_, points[i].at), {points[i].s, points[i].t}};
    };
    for (std::size_t i = 2; i < points.size(); ++i)
      scanner_.scan({corner(0), corner(i - 1), corner(i)}, [&](int x, int y, double nearness,
                                                               const auto& values) {
        fragments_[static_cast<std::size_t>(y) * width_ + static_cast<std::size_t>(x)].put(
            {kind, patch, nearness, values[0], values[1]});
      });
  }

  // Entries of all pixels, at y * width + x; rows run from the top.
  const std::vector<Fragment>& fragments() const { return fragments_; }

 private:
  const renderer::View view_;
  const std::size_t width_;
  renderer::Scanner<2> scanner_;
  std::vector<Fragment> fragments_;
};

// The mean radiosity of the patches, weighted by area and averaged over the colours.
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

base::Fields<PictureParams> picture_fields() {
  using D = base::Declare<PictureParams>;
  return {D::whole("width", &PictureParams::width, 0, renderer::MAX_SIDE, "pixels",
                   "width of pictures; 0: the room's"),
          D::whole("height", &PictureParams::height, 0, renderer::MAX_SIDE, "pixels",
                   "height of pictures; 0: the room's"),
          D::whole("pixel_samples", &PictureParams::samples, 1, 64, "",
                   "number of rays per pixel in each direction (n means n x n)"),
          D::whole("depth", &PictureParams::depth, 0, 1000, "",
                   "largest number of mirrors on the path of a ray from the eye")};
}

void check(const PictureParams& params) {
  PictureParams sized = params;
  if (params.width == 0) sized.width = 1;
  if (params.height == 0) sized.height = 1;
  check(make_params(sized));
  renderer::require_allowed(picture_fields(), params);
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
  Tracer tracer{mesh, make_sides(mesh), params.depth, work};
  Picture picture{params.width, params.height, {}};
  for (int y = 0; y < params.height; ++y)
    for (int x = 0; x < params.width; ++x) {
      Rgb sum;
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i)
          if (const auto seen = tracer.trace(make_primary(eye, fine, n * x + i, n * y + j))) {
            const auto& [patch, s, t] = seen->spot;
            sum += seen->influence * eval_illumination(illumination, patch, s, t);
          }
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
  ZBuffer buffer(eye, make_params(params));
  const auto side = [&](const Vec& normal, const Vec& corner, Kind front) {
    return dot(normal, eye.from - corner) > 0 ? front : Kind::back;
  };
  for (std::uint32_t i = 0; i < mesh.patches.size(); ++i) {
    const Patch& patch = mesh.patches[i];
    const auto& at = patch.at;
    buffer.draw(side(patch.normal, at[0], Kind::patch), i,
                {{at[0], 0, 0}, {at[1], 1, 0}, {at[2], 1, 1}, {at[3], 0, 1}});
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

std::vector<Rgb> find_shares(const Mesh& mesh, const renderer::View& view,
                             const PictureParams& asked) {
  const PictureParams params = fit(asked, view);
  const renderer::View eye = make_image_plane(view);
  Work ignored;
  Tracer tracer{mesh, make_sides(mesh), params.depth, ignored};
  std::vector<Rgb> shares(mesh.patches.size());
  const renderer::Params pixels = make_params(params);
  const double pixel = 1.0 / params.width / params.height;
  for (int y = 0; y < params.height; ++y)
    for (int x = 0; x < params.width; ++x)
      if (const auto seen = tracer.trace(make_primary(eye, pixels, x, y)))
        shares[seen->spot.patch] += pixel * (seen->influence * seen->influence);
  return shares;
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
