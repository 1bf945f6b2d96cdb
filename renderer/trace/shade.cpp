#include "renderer/trace/shade.hpp"

#include "renderer/trace/raster.hpp"

namespace renderer {

namespace {

// The power is rounded to float: the same value whichever library computes it.
double eval_highlight(double cosine, double shine) {
  return cosine > 0 ? static_cast<double>(static_cast<float>(std::pow(cosine, shine))) : 0.0;
}

// A ray that leaves the hit of `ray`, without its direction and influence.
Ray make_child(const Ray& ray, const Hit& hit, RayKind kind) {
  Ray child;
  child.origin = hit.point;
  child.sample = ray.sample;
  child.from = hit.object;
  child.level = static_cast<std::uint16_t>(ray.level + 1);
  child.kind = kind;
  child.through = ray.through || kind == RayKind::transmitted;
  child.is_urgent = ray.is_urgent;
  child.order = ray.order;
  return child;
}

// fS = f * (kd * cos(theta) + kr * cos^n(phi)), Eq 4.17; 0 for a light behind the surface.
Rgb eval_feeler_influence(const Surface& s, const Hit& hit, const Rgb& f, const Vec& to_light,
                          const Vec& mirrored) {
  const double cosine = dot(hit.normal, to_light);
  if (!(cosine > 0)) return {};
  const double highlight = s.ks > 0 ? s.ks * eval_highlight(dot(mirrored, to_light), s.shine) : 0;
  return f * (s.kd * cosine * s.colour + Rgb{highlight, highlight, highlight});
}

void add_feelers(const Scene& scene, const Params& params, const Ray& ray, const Hit& hit,
                 const Vec& mirrored, Children& out, Work& work) {
  const Surface& surface = scene.surfaces[hit.surface];
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    const Vec to_light = scene.lights[i].at - hit.point;
    if (params.feelers == Feelers::front && !(dot(hit.normal, to_light) > 0)) continue;
    Ray feeler = make_child(ray, hit, RayKind::shadow);
    feeler.reach = length(to_light);
    feeler.direction = feeler.reach > 0 ? (1 / feeler.reach) * to_light : hit.normal;
    feeler.influence =
        eval_feeler_influence(surface, hit, ray.influence, feeler.direction, mirrored);
    feeler.light = static_cast<std::uint16_t>(i);
    work[Op::feeler_made] += 1;
    out.push_back(feeler);
  }
}

void add_branches(const Scene& scene, const Params& params, const Ray& ray, const Hit& hit,
                  const Vec& mirrored, Children& out, Work& work) {
  if (ray.level >= params.limits.depth) return;
  const Surface& surface = scene.surfaces[hit.surface];
  const double influence = max_influence(ray), least = params.limits.min_influence;
  if (surface.ks > 0 && influence * surface.ks >= least) {
    Ray reflected = make_child(ray, hit, RayKind::reflected);
    reflected.direction = mirrored;
    reflected.influence = surface.ks * ray.influence;
    work[Op::ray_reflected] += 1;
    out.push_back(reflected);
  }
  if (surface.t > 0 && influence * surface.t >= least) {
    const auto direction =
        refract(ray.direction, hit.normal, hit.inside ? 1 / surface.ior : surface.ior);
    if (!direction) return;
    Ray transmitted = make_child(ray, hit, RayKind::transmitted);
    transmitted.direction = *direction;
    transmitted.influence = surface.t * ray.influence;
    work[Op::ray_refracted] += 1;
    out.push_back(transmitted);
  }
}

}  // namespace

PlanePoint make_plane_point(const View& view, const Params& p, int x, int y) {
  const Raster raster = make_raster(view, p);
  return {(x - raster.left) * raster.step, (raster.top - y) * raster.step};
}

Ray make_primary(const View& view, const Params& p, int x, int y) {
  const PlanePoint at = make_plane_point(view, p, x, y);
  Ray ray;
  ray.origin = view.from;
  ray.direction = normalize(view.ahead + at.right * view.right + at.above * view.above);
  ray.influence = {1, 1, 1};
  ray.sample = static_cast<std::uint32_t>(y) * static_cast<std::uint32_t>(p.width) +
               static_cast<std::uint32_t>(x);
  return ray;
}

Vec reflect(const Vec& direction, const Vec& normal) {
  return normalize(direction - 2 * dot(direction, normal) * normal);
}

std::optional<Vec> refract(const Vec& direction, const Vec& normal, double ratio) {
  const double eta = 1 / ratio, cosine = -dot(direction, normal);
  const double square = 1 - eta * eta * (1 - cosine * cosine);
  if (!(square >= 0)) return std::nullopt;
  return normalize(eta * direction + (eta * cosine - std::sqrt(square)) * normal);
}

void make_children(const Scene& scene, const Params& params, const Ray& ray, const Hit& hit,
                   Children& out, Work& work) {
  if (ray.kind == RayKind::shadow) return;
  work[Op::surface_shaded] += 1;
  const Vec mirrored = reflect(ray.direction, hit.normal);
  add_feelers(scene, params, ray, hit, mirrored, out, work);
  add_branches(scene, params, ray, hit, mirrored, out, work);
}

void make_branches(const Scene& scene, const Params& params, const Ray& ray, const Hit& hit,
                   Children& out, Work& work) {
  if (ray.kind == RayKind::shadow) return;
  work[Op::surface_shaded] += 1;
  add_branches(scene, params, ray, hit, reflect(ray.direction, hit.normal), out, work);
}

Rgb eval_contribution(const Scene& scene, const Params& params, const Ray& ray,
                      const std::optional<Hit>& hit, Work& work) {
  if (ray.kind == RayKind::shadow) {
    if (hit) return {};
    work[Op::sample_updated] += 1;
    return ray.influence * scene.lights[ray.light].intensity;
  }
  work[Op::sample_updated] += 1;
  if (!hit) return ray.influence * scene.background;
  const Surface& surface = scene.surfaces[hit->surface];
  return params.ambient * surface.kd * ray.influence * surface.colour;
}

}  // namespace renderer
