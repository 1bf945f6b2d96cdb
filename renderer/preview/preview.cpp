#include "renderer/preview/preview.hpp"

#include "renderer/preview/facets.hpp"
#include "renderer/scan/scan.hpp"
#include "renderer/trace/shade.hpp"

namespace renderer {

namespace {

using Triple = std::array<double, 3>;  // a colour or a normal

Rgb to_colour(const Triple& t) { return {t[0], t[1], t[2]}; }
Vec to_vec(const Triple& t) { return {t[0], t[1], t[2]}; }
Triple to_triple(const Rgb& c) { return {c.r, c.g, c.b}; }
Triple to_triple(const Vec& v) { return {v.x, v.y, v.z}; }

// An entry of the z-buffer: the nearest object found so far at a pixel.
struct Fragment {
  double nearness = 0;  // 1 / depth; 0 if the pixel is empty
  Place place;
  std::uint32_t object = NO_OBJECT;
  Triple values{};
};

// The object that is being drawn.
struct Object {
  Place place;
  Tag tag;
  Facets facets;
  // Colours of the corners, seen from outside [0] and inside [1]; none if not yet computed.
  std::array<std::vector<std::optional<Rgb>>, 2> colours;
};

struct Facet {
  std::span<const std::uint32_t> corners;
  Vec middle;
  Vec normal;         // unit normal towards the eye
  bool back = false;  // the eye sees the facet from inside the object
};

Facet make_facet(const Object& object, const Vec& eye, std::span<const std::uint32_t> indices) {
  Facet facet{indices, {}, {}};
  const auto& corners = object.facets.corners;
  for (const auto i : indices)
    facet.middle += (1.0 / static_cast<double>(indices.size())) * corners[i].at;
  Vec newell, outwards;
  std::uint32_t last = indices.back();
  for (const auto i : indices) {
    newell += cross(corners[last].at - facet.middle, corners[i].at - facet.middle);
    outwards += corners[i].normal;
    last = i;
  }
  // At the apex of a cone, a facet has an edge of length zero, but its area is not zero.
  const double area = length(newell);
  facet.normal = area > 0 ? (1 / area) * newell : normalize(outwards);
  if (dot(facet.normal, outwards) < 0) facet.normal = -facet.normal;
  facet.back = dot(facet.normal, eye - facet.middle) < 0;
  if (facet.back) facet.normal = -facet.normal;
  return facet;
}

// True if the eye cannot see the inside of the object: it is a sphere, and the eye is outside.
bool is_closed_to(const Scene& scene, Place place, const Vec& eye) {
  if (place.kind() != Kind::sphere) return false;
  const Sphere& sphere = scene.spheres[place.index()];
  return length(eye - sphere.centre) > sphere.radius;
}

class Previewer {
 public:
  Previewer(const Scene& scene, const Params& params)
      : scene_(scene),
        params_(params),
        area_(get_area(params)),
        raster_(make_raster(scene.view, params)),
        scanner_(raster_, area_),
        pixels_(static_cast<std::size_t>(params.width) * static_cast<std::size_t>(params.height)) {
    params_.limits.depth = 1;  // a hit then makes rays to the lights only
    preview_.samples = Samples(params.width, params.height);
  }

  Preview make(PreviewStep step) {
    switch (step) {
      case PreviewStep::points:
        draw_points();
        break;
      case PreviewStep::edges:
        draw_edges();
        break;
      case PreviewStep::flat:
        draw_facets(Fineness::silhouette, [&](Object& object, const Facet& facet) {
          const Triple colour = to_triple(shade(object, facet, facet.middle, facet.normal));
          return [colour](std::uint32_t) { return colour; };
        });
        break;
      case PreviewStep::gouraud:
        draw_facets(Fineness::silhouette, [&](Object& object, const Facet& facet) {
          return [&](std::uint32_t corner) { return to_triple(shade(object, facet, corner)); };
        });
        break;
      case PreviewStep::phong:
      case PreviewStep::shadows:
        draw_facets(Fineness::silhouette, [&](Object& object, const Facet&) {
          return [&](std::uint32_t i) { return to_triple(object.facets.corners[i].normal); };
        });
        break;
    }
    const bool lit = step == PreviewStep::phong || step == PreviewStep::shadows;
    for (int y = area_.y; y < area_.y + area_.height; ++y)
      for (int x = area_.x; x < area_.x + area_.width; ++x)
        if (lit && at(x, y).object != NO_OBJECT)
          light_pixel(x, y, step == PreviewStep::shadows);
        else
          preview_.samples.add(index(x, y), at(x, y).object != NO_OBJECT
                                                ? to_colour(at(x, y).values)
                                                : scene_.background);
    for (const Fragment& pixel : pixels_) preview_.objects.push_back(pixel.object);
    return std::move(preview_);
  }

 private:
  std::uint32_t index(int x, int y) const {
    return static_cast<std::uint32_t>(y) * static_cast<std::uint32_t>(params_.width) +
           static_cast<std::uint32_t>(x);
  }
  Fragment& at(int x, int y) { return pixels_[index(x, y)]; }

  // Writes a fragment to the z-buffer if it is nearer than the previous one. If two fragments
  // are equally near up to rounding, the first one remains.
  void put(int x, int y, const Fragment& fragment) {
    constexpr double EQUAL = 1 + 1e-12;
    ++preview_.counts.pixels_tested;
    Fragment& pixel = at(x, y);
    if (!(fragment.nearness > pixel.nearness * EQUAL)) return;
    ++preview_.counts.pixels_drawn;
    pixel = fragment;
  }

  // Calls draw(object) for every object, in the order of the scene file.
  template <class Draw>
  void for_each_object(Fineness fineness, const Draw& draw) {
    Object object;
    for (const Place place : scene_.objects) {
      object.place = place;
      object.tag = visit(scene_, place, [](const auto& primitive) { return primitive.tag; });
      make_facets(scene_, place, params_, fineness, object.facets);
      for (auto& side : object.colours) side.assign(object.facets.corners.size(), std::nullopt);
      preview_.counts.vertices += object.facets.corners.size();
      draw(object);
    }
  }

  // Calls draw(facet) for every facet of the object that may be visible.
  template <class Draw>
  void for_each_facet(const Object& object, const Draw& draw) {
    const bool closed = is_closed_to(scene_, object.place, scene_.view.from);
    std::uint32_t first = 0;
    for (const auto end : object.facets.ends) {
      const Facet facet = make_facet(object, scene_.view.from,
                                     std::span(object.facets.indices).subspan(first, end - first));
      first = end;
      if (closed && facet.back) continue;
      ++preview_.counts.facets;
      draw(facet);
    }
  }

  Scanner<3>::Corner make_corner(const Object& object, std::uint32_t i, const Triple& values) {
    return {to_eye(scene_.view, object.facets.corners[i].at), values};
  }

  // Draws all facets into the z-buffer. values(object, facet) returns a function that maps a corner
  // to the values that are interpolated over the facet.
  template <class Values>
  void draw_facets(Fineness fineness, const Values& values) {
    std::vector<Scanner<3>::Corner> corners;
    for_each_object(fineness, [&](Object& object) {
      for_each_facet(object, [&](const Facet& facet) {
        const auto value = values(object, facet);
        corners.clear();
        for (const auto i : facet.corners) corners.push_back(make_corner(object, i, value(i)));
        scanner_.scan(corners, [&](int x, int y, double nearness, const Triple& found) {
          put(x, y, {nearness, object.place, object.tag.object, found});
        });
      });
    });
  }

  void draw_points() {
    for_each_object(Fineness::outline, [&](const Object& object) {
      for (const auto& corner : object.facets.corners) {
        const Vec p = to_eye(scene_.view, corner.at);
        if (!(p.z > 0)) continue;
        const double x = std::floor(raster_.left + p.x / p.z / raster_.step + 0.5),
                     y = std::floor(raster_.top - p.y / p.z / raster_.step + 0.5);
        if (x >= area_.x && x < area_.x + area_.width && y >= area_.y && y < area_.y + area_.height)
          put(static_cast<int>(x), static_cast<int>(y), make_fragment(object, 1 / p.z));
      }
    });
    cue_depth();
  }

  Fragment make_fragment(const Object& object, double nearness) const {
    return {nearness, object.place, object.tag.object,
            to_triple(scene_.surfaces[object.tag.surface].colour)};
  }

  // Draws all edges that are not hidden by a facet in the z-buffer.
  void draw_edges() {
    draw_facets(Fineness::outline,
                [](const Object&, const Facet&) { return [](std::uint32_t) { return Triple{}; }; });
    std::vector<Fragment> facets(pixels_.size());
    facets.swap(pixels_);  // `facets` keeps the z-buffer of facets; edges get an empty one
    for_each_object(Fineness::outline, [&](const Object& object) {
      for_each_facet(object, [&](const Facet& facet) {
        const double slack = eval_slack(facet);
        std::uint32_t last = facet.corners.back();
        for (const auto i : facet.corners) {
          scanner_.draw_line(make_corner(object, last, {}), make_corner(object, i, {}),
                             [&](int x, int y, double nearness, const Triple&) {
                               if (nearness + std::min(slack, MOST_SLACK * nearness) >=
                                   facets[index(x, y)].nearness)
                                 put(x, y, make_fragment(object, nearness));
                             });
          last = i;
        }
      });
    });
    cue_depth();
  }

  // An edge that lies behind a facet is still drawn if its 1 / depth is smaller by at most this
  // fraction.
  static constexpr double MOST_SLACK = 0.02;

  // Change of 1 / depth between neighbouring pixels of a facet. Rounding to pixels can put an edge
  // behind its own facet by this amount. Such an edge must still be drawn.
  double eval_slack(const Facet& facet) const {
    const View& view = scene_.view;
    const double offset = std::abs(dot(facet.normal, facet.middle - view.from));
    return raster_.step *
           (std::abs(dot(facet.normal, view.right)) + std::abs(dot(facet.normal, view.above))) /
           std::max(offset, 1e-300);
  }

  // Depth cueing: blends each pixel with the background according to its depth. The nearest pixel
  // keeps its colour, and the farthest keeps a quarter of it.
  void cue_depth() {
    double nearest = 0, farthest = std::numeric_limits<double>::infinity();
    for (const Fragment& pixel : pixels_)
      if (pixel.object != NO_OBJECT) {
        nearest = std::max(nearest, pixel.nearness);
        farthest = std::min(farthest, pixel.nearness);
      }
    const double from = 1 / nearest, range = 1 / farthest - from;
    for (Fragment& pixel : pixels_) {
      if (pixel.object == NO_OBJECT) continue;
      const double depth = range > 0 ? (1 / pixel.nearness - from) / range : 0,
                   share = 0.75 * depth;
      pixel.values = to_triple((1 - share) * to_colour(pixel.values) + share * scene_.background);
    }
  }

  // Calls add(share) for each contribution to the light that leaves the point hit by `ray` towards
  // the eye. Calls the ray tracer's functions, so that both have the same illumination model.
  template <class Add>
  void shine(const Ray& ray, const Hit& hit, bool shadows, const Add& add) {
    Work& work = preview_.work;
    add(eval_contribution(scene_, params_, ray, hit, work));
    feelers_.clear();
    make_children(scene_, params_, ray, hit, feelers_, work);
    for (const Ray& feeler : feelers_)
      add(eval_contribution(
          scene_, params_, feeler,
          shadows ? intersect(scene_, feeler, params_.traversal, work) : std::optional<Hit>{},
          work));
  }

  // The colour at a point of a facet. `normal` must point to the visible side.
  Rgb shade(const Object& object, const Facet& facet, const Vec& point, const Vec& normal) {
    Ray ray;
    ray.origin = scene_.view.from;
    const Vec way = point - ray.origin;
    const double distance = length(way);
    ray.direction = distance > 0 ? (1 / distance) * way : -normal;
    ray.influence = {1, 1, 1};
    Rgb colour;
    shine(ray, {distance, point, normal, object.tag.surface, object.tag.object, facet.back}, false,
          [&](const Rgb& share) { colour += share; });
    return colour;
  }

  // The colour at corner `i` with the normal of the curved object. Computed only once for each
  // side.
  Rgb shade(Object& object, const Facet& facet, std::uint32_t i) {
    auto& colour = object.colours[facet.back][i];
    if (!colour) {
      const auto& corner = object.facets.corners[i];
      const Vec normal = facet.back ? -corner.normal : corner.normal;
      // The interpolated normal of a patch may point away from the eye. As in the ray tracer, the
      // facet's normal then replaces it.
      const bool turned =
          object.place.kind() == Kind::patch && dot(normal, corner.at - scene_.view.from) > 0;
      colour = shade(object, facet, corner.at, turned ? facet.normal : normal);
    }
    return *colour;
  }

  // Adds the light at the visible point of the object that the pixel shows.
  void light_pixel(int x, int y, bool shadows) {
    const Fragment& pixel = at(x, y);
    const Ray ray = make_primary(scene_.view, params_, x, y);
    auto hit = intersect_object(scene_, ray, pixel.place, preview_.work);
    if (!hit) {  // near the outline, rounding may make the ray miss: use the facet
      const Tag tag = visit(scene_, pixel.place, [](const auto& p) { return p.tag; });
      const double distance = 1 / (pixel.nearness * dot(ray.direction, scene_.view.ahead));
      Vec normal = normalize(to_vec(pixel.values));
      const bool inside = dot(normal, ray.direction) > 0;
      if (inside) normal = -normal;
      hit = Hit{distance, ray.origin + distance * ray.direction, normal, tag.surface, tag.object,
                inside};
    }
    shine(ray, *hit, shadows, [&](const Rgb& share) { preview_.samples.add(index(x, y), share); });
  }

  const Scene& scene_;
  Params params_;
  const Area area_;
  const Raster raster_;
  Scanner<3> scanner_;
  std::vector<Fragment> pixels_;
  Children feelers_;
  Preview preview_;
};

}  // namespace

const base::Names<PreviewStep>& preview_steps() {
  static const base::Names<PreviewStep> STEPS = {
      {"points", PreviewStep::points}, {"edges", PreviewStep::edges},
      {"flat", PreviewStep::flat},     {"gouraud", PreviewStep::gouraud},
      {"phong", PreviewStep::phong},   {"shadows", PreviewStep::shadows}};
  return STEPS;
}

Preview make_preview(const Scene& scene, const Params& params, PreviewStep step) {
  check(params);
  return Previewer(scene, params).make(step);
}

}  // namespace renderer
