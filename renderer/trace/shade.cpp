#include "renderer/trace/shade.hpp"

#include "renderer/trace/raster.hpp"

namespace renderer {

namespace {

// Phong's highlight. The power is rounded to float, so that the result does not depend on the
// host's maths library.
double eval_highlight(double cosine, double shine) {
  return cosine > 0 ? static_cast<double>(static_cast<float>(std::pow(cosine, shine))) : 0.0;
}

// Returns a point on the visible side of a spherical light, uniformly distributed in solid angle as
// seen from `from`. If `from` is inside the light, returns the light's centre.
Vec find_on_sphere(const Light& light, const SquarePoint& at, const Vec& from) {
  const Vec to_middle = light.at - from;
  const double square = dot(to_middle, to_middle), radius_square = light.radius * light.radius;
  if (square <= radius_square) return light.at;
  // Maps equal areas of the disc to equal solid angles: 1 - cos grows with the square of the
  // radius. `most` is the squared sine of the largest angle from the direction to the light's
  // centre.
  const double most = radius_square / square;
  const double rise = most / (1 + std::sqrt(1 - most));
  const auto [u, v] = map_to_disc(at);
  const double share = std::min(1.0, u * u + v * v), cosine = 1 - rise * share;
  // The sine, divided by the radius on the disc. The form sine^2 = (1 - cosine) (1 + cosine) avoids
  // cancellation.
  const double scale = std::sqrt(rise * (1 + cosine));
  const Vec axis = normalize(to_middle);
  const Across across = make_across(axis);
  const Vec way = cosine * axis + scale * (u * across.u + v * across.v);
  const double middle = std::sqrt(square) * cosine;
  const double half_square = radius_square - square * (1 - cosine * cosine);
  return from + (middle - std::sqrt(std::max(0.0, half_square))) * way;
}

// Makes a ray that starts at the hit of `ray`, without direction and influence.
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
  child.pass = ray.pass;
  child.path = 2 * ray.path + (kind == RayKind::transmitted);
  child.time = ray.time;
  child.travelled = ray.travelled + static_cast<float>(hit.distance);
  return child;
}

SampleKey key_of(const Ray& ray, std::uint32_t path) { return {ray.sample, ray.pass, path}; }

// The point of a light that this sample uses, as seen from `from`. (Its random numbers depend on
// the ray's path combined with the number of the light.)
Vec find_light(const Light& light, const Sampling& sampling, const Ray& ray, std::size_t number,
               const Vec& from) {
  if (light.shape == LightShape::point) return light.at;
  const auto path = ray.path + static_cast<std::uint32_t>(number) * 0x9E3779B9u;
  const SquarePoint p = sample_square(sampling, key_of(ray, path), Dimension::light);
  if (light.shape == LightShape::rectangle)
    return light.at + (2 * p.u - 1) * light.u + (2 * p.v - 1) * light.v;
  return find_on_sphere(light, p, from);
}

// A direction near `axis`: towards a point of a disc with this radius, perpendicular to `axis` at
// distance 1.
Vec spread(const Vec& axis, double radius, const Vec& normal, const SquarePoint& at) {
  const auto [u, v] = map_to_disc(at);
  const Across across = make_across(axis);
  const Vec way = normalize(axis + radius * (u * across.u + v * across.v));
  const double side = dot(way, normal);
  return side * dot(axis, normal) < 0 ? way - 2 * side * normal : way;
}

// The width over which a texture is filtered: one pixel, or half a pixel if pixels have several
// samples (as with 2 x 2 samples). It must not depend on the number of samples, because adaptive
// sampling does not know this number in advance.
double eval_pixel_width(const Scene& scene, const Params& params, const Ray& ray, const Hit& hit) {
  const double share = params.sampling.pixel_samples > 1 ? 0.5 : 1;
  return share * make_raster(scene.view, params).step * (ray.travelled + hit.distance);
}

Rgb eval_texture(const Scene& scene, const Params& params, const Ray& ray, const Hit& hit,
                 Work& work) {
  const Texture& texture = scene.textures[scene.surfaces[hit.surface].texture];
  const Pyramid& pyramid = scene.pyramids[texture.pyramid];
  const Vec point =
      scene.moves.empty() ? hit.point : hit.point - eval_shift(scene, hit.object, ray.time);
  const TexturePoint at = find_texture_point(scene, texture, hit.object, point);
  // Projects onto the surface, because gradients of spherical and planar mappings need not lie in
  // it.
  const auto along = [&](const Vec& way) {
    return length(way - dot(way, hit.normal) * hit.normal);
  };
  const Level& first = pyramid.levels.front();
  const double texels = std::max(first.width * along(at.grow_u), first.height * along(at.grow_v));
  const double width = eval_pixel_width(scene, params, ray, hit);
  const double cosine = std::abs(dot(ray.direction, hit.normal));
  const auto [colour, read] =
      eval_filtered(pyramid, at.u, at.v, width * texels / cosine, at.beyond);
  work[Op::texture_mapped] += 1;
  work[Op::texel_mixed] += static_cast<std::uint64_t>(read);
  return colour;
}

// Computes fS = f * (kd * cos(theta) + kr * cos^n(phi)), thesis Eq 4.17; 0 for a light behind the
// surface.
Rgb eval_feeler_influence(const Surface& s, const Rgb& colour, const Hit& hit, const Rgb& f,
                          const Vec& to_light, const Vec& mirrored) {
  const double cosine = dot(hit.normal, to_light);
  if (!(cosine > 0)) return {};
  const double highlight = s.ks > 0 ? s.ks * eval_highlight(dot(mirrored, to_light), s.shine) : 0;
  return f * (s.kd * cosine * colour + Rgb{highlight, highlight, highlight});
}

void add_feelers(const Scene& scene, const Params& params, const Ray& ray, const Hit& hit,
                 const Vec& mirrored, Children& out, Work& work) {
  const Surface& surface = scene.surfaces[hit.surface];
  if (scene.lights.empty()) return;
  const Rgb colour = colour_of(scene, params, ray, hit, work);
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    const Vec to_light =
        find_light(scene.lights[i], params.sampling, ray, i, hit.point) - hit.point;
    if (params.feelers == Feelers::front && !(dot(hit.normal, to_light) > 0)) continue;
    Ray feeler = make_child(ray, hit, RayKind::shadow);
    feeler.reach = length(to_light);
    feeler.direction = feeler.reach > 0 ? (1 / feeler.reach) * to_light : hit.normal;
    feeler.influence =
        eval_feeler_influence(surface, colour, hit, ray.influence, feeler.direction, mirrored);
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
    if (surface.gloss > 0)
      reflected.direction =
          spread(mirrored, surface.gloss, hit.normal,
                 sample_square(params.sampling, key_of(ray, reflected.path), Dimension::gloss));
    reflected.influence = surface.ks * ray.influence;
    work[Op::ray_reflected] += 1;
    out.push_back(reflected);
  }
  if (surface.t > 0 && influence * surface.t >= least) {
    const auto refracted =
        refract(ray.direction, hit.normal, hit.inside ? 1 / surface.ior : surface.ior);
    if (!refracted && surface.translucency == 0 && params.total_reflection == TotalReflection::lost)
      return;
    const Vec direction = refracted.value_or(mirrored);
    Ray transmitted = make_child(ray, hit, RayKind::transmitted);
    transmitted.direction = direction;
    if (surface.translucency > 0)
      transmitted.direction = spread(
          direction, surface.translucency, hit.normal,
          sample_square(params.sampling, key_of(ray, transmitted.path), Dimension::translucency));
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

namespace {

// The view when the fraction `share` of the shutter's time has passed.
View move(View view, double share) {
  view.from += share * view.from_move;
  view.at += share * view.at_move;
  point(view);
  return view;
}

SampleKey make_key(const Params& p, int x, int y, int pass) {
  return {static_cast<std::uint32_t>(y) * static_cast<std::uint32_t>(p.width) +
              static_cast<std::uint32_t>(x),
          pass};
}

// A ray from the centre of the lens to a point of the image plane at distance 1. The direction is
// not normalised.
Ray make_eye_ray(const View& view, const Params& p, int x, int y, const SquarePoint& in_pixel) {
  const Raster raster = make_raster(view, p);
  const double right = (x + in_pixel.u - raster.left) * raster.step;
  const double above = (raster.top - (y + in_pixel.v)) * raster.step;
  Ray ray;
  ray.origin = view.from;
  ray.direction = view.ahead + right * view.right + above * view.above;
  ray.influence = {1, 1, 1};
  ray.sample = make_key(p, x, y, 0).pixel;
  return ray;
}

// Offset in pixels from a pixel's upper left corner to the position `p.sample`.
double shift_of(const Params& p) { return p.sample == SamplePosition::corner ? 0 : 0.5; }

// Makes a ray from a point of the lens. `view` is the view at the ray's time.
Ray make_lens_ray(const View& view, const Params& p, int x, int y, int pass) {
  const SampleKey key = make_key(p, x, y, pass);
  SquarePoint in_pixel;
  if (p.sampling.pixel_samples > 1) {
    in_pixel = sample_square(p.sampling, key, Dimension::pixel);
    in_pixel.u -= shift_of(p);
    in_pixel.v -= shift_of(p);
  }
  Ray ray = make_eye_ray(view, p, x, y, in_pixel);
  ray.pass = static_cast<std::uint16_t>(pass);
  const double radius = p.sampling.lens * view.lens.aperture / 2;
  if (radius > 0) {
    // All rays through one point of the image meet in the plane in focus.
    const auto [u, v] = map_to_disc(sample_square(p.sampling, key, Dimension::lens));
    const Vec in_focus = ray.origin + view.lens.focus * ray.direction;
    ray.origin += radius * (u * view.right + v * view.above);
    ray.direction = in_focus - ray.origin;
  }
  ray.direction = normalize(ray.direction);
  return ray;
}

}  // namespace

Ray make_primary(const View& view, const Params& p, int x, int y, int pass) {
  if (!view.has_motion) return make_lens_ray(view, p, x, y, pass);
  const auto time = static_cast<float>(
      p.sampling.shutter * sample_line(p.sampling, make_key(p, x, y, pass), Dimension::time));
  Ray ray = make_lens_ray(move(view, time), p, x, y, pass);
  ray.time = time;
  return ray;
}

Ray make_probe(const View& view, const Params& p, int x, int y) {
  const double time = 0.5 * p.sampling.shutter;
  const SquarePoint corner{-shift_of(p), -shift_of(p)};
  Ray ray = make_eye_ray(view.has_motion ? move(view, time) : view, p, x, y, corner);
  ray.direction = normalize(ray.direction);
  ray.time = static_cast<float>(time);
  ray.kind = RayKind::probe;
  const Area area = get_area(p);
  ray.sample =
      make_key(p, std::min(x, area.x + area.width - 1), std::min(y, area.y + area.height - 1), 0)
          .pixel;
  ray.path = static_cast<std::uint32_t>(y) * (static_cast<std::uint32_t>(p.width) + 1) +
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
  if (ray.kind == RayKind::shadow || ray.kind == RayKind::probe) return;
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

Rgb colour_of(const Scene& scene, const Params& params, const Ray& ray, const Hit& hit,
              Work& work) {
  const Surface& surface = scene.surfaces[hit.surface];
  return surface.texture == NO_TEXTURE
             ? surface.colour
             : surface.colour * eval_texture(scene, params, ray, hit, work);
}

Rgb eval_contribution(const Scene& scene, const Params& params, const Ray& ray,
                      const std::optional<Hit>& hit, Work& work) {
  if (ray.kind == RayKind::shadow) {
    if (hit) return {};
    work[Op::sample_updated] += 1;
    return weight_of(params.sampling) * ray.influence * scene.lights[ray.light].intensity;
  }
  work[Op::sample_updated] += 1;
  const double weight = weight_of(params.sampling);
  if (!hit) return weight * ray.influence * scene.background;
  const double kd = scene.surfaces[hit->surface].kd;
  return weight * params.ambient * kd * ray.influence * colour_of(scene, params, ray, *hit, work);
}

}  // namespace renderer
