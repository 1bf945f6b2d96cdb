#include "tests/reference/path_tracer.hpp"

#include <array>
#include <atomic>
#include <boost/random/sobol.hpp>
#include <map>
#include <numbers>
#include <thread>

#include "base/random.hpp"
#include "renderer/scene/require.hpp"
#include "tests/reference/room_geometry.hpp"

namespace radiosity::reference {

namespace {

constexpr double PI = std::numbers::pi;
constexpr int MOST_MIRRORS = 1000;  // limit on the number of successive mirrors in a path

// Random numbers for a path. The first DIMENSIONS numbers are a Sobol point, shifted by random
// numbers of the pixel and the round (R. Cranley and T. Patterson, 1976). All further numbers are
// independent.
class Numbers {
 public:
  static constexpr std::size_t DIMENSIONS = 20;
  using Point = std::array<double, DIMENSIONS>;

  Numbers(const Point& point, std::uint64_t pixel_key, std::uint64_t path)
      : point_(point), shifts_(pixel_key), path_(base::random_at(pixel_key, ~path)) {}

  double next() {
    const std::size_t i = count_++;
    if (i >= DIMENSIONS) return random(path_, i);
    const double shifted = point_[i] + random(shifts_, i);
    return shifted < 1 ? shifted : shifted - 1;
  }

  static double random(std::uint64_t key, std::uint64_t i) {
    return static_cast<double>(base::random_at(key, i) >> 11) * 0x1p-53;
  }

 private:
  const Point& point_;
  std::uint64_t shifts_, path_;
  std::size_t count_ = 0;
};

std::vector<Numbers::Point> make_points(int count) {
  boost::random::sobol sobol(Numbers::DIMENSIONS);
  std::vector<Numbers::Point> points(static_cast<std::size_t>(count));
  for (auto& point : points)
    for (double& x : point) x = static_cast<double>(sobol()) * 0x1p-64;
  return points;
}

// A triangle of a face that emits light.
struct Emitter {
  Vec a, b, c, normal;
  std::uint32_t face = 0;
  bool two_sided = false;
  Rgb emission;
  double area = 0;
  double until = 0;  // share of the power of this triangle and all earlier ones
  double share = 0;  // share of the power of this triangle
};

std::vector<Emitter> make_emitters(const Room& room, const RoomGeometry& geometry) {
  std::vector<Emitter> emitters;
  double total = 0;
  for (std::uint32_t f = 0; f < room.faces.size(); ++f) {
    const Rgb& emission = room.materials[room.faces[f].material].emission;
    if (max_component(emission) <= 0) continue;
    const auto& at = geometry.corners(f);
    for (std::size_t i = 2; i < at.size(); ++i) {
      const double area = length(cross(at[i - 1] - at[0], at[i] - at[0])) / 2;
      const double power = sum(emission) * area;
      emitters.push_back({at[0], at[i - 1], at[i], geometry.normal(f), f, room.faces[f].two_sided,
                          emission, area, total += power, power});
    }
  }
  for (Emitter& e : emitters) e.until /= total, e.share /= total;
  return emitters;
}

// Chooses a direction in the hemisphere around `normal`, with a density proportional to the cosine
// of its angle to the normal.
Vec sample_hemisphere(const Vec& normal, double u, double v) {
  const Vec across =
      normalize(cross(normal, std::abs(normal.x) < 0.5 ? Vec{1, 0, 0} : Vec{0, 1, 0}));
  const double radius = std::sqrt(u), angle = 2 * PI * v;
  return normalize(radius * std::cos(angle) * across +
                   radius * std::sin(angle) * cross(normal, across) + std::sqrt(1 - u) * normal);
}

class PathTracer {
 public:
  explicit PathTracer(const Room& room)
      : room_(room), geometry_(room), emitters_(make_emitters(room, geometry_)) {}

  // What is seen along a ray: the first diffuse surface, and the mirrors before it.
  struct Sight {
    SurfacePoint point;
    Rgb tint{1, 1, 1};  // product of the reflectances of the mirrors
    int mirrors = 0;
    std::uint32_t number = 0;  // number of the visible face, as in Reference::faces
  };
  std::optional<Sight> look(const Vec& origin, Vec direction, std::uint32_t from, int depth) const {
    Sight sight{{origin, {}, from}};
    for (;; ++sight.mirrors) {
      const auto met = geometry_.intersect(sight.point.at, direction, sight.point.face);
      if (!met) return std::nullopt;
      sight.point = *met;
      sight.number = sight.number * 0x9E3779B1U + met->face + 1;
      const Material& material = material_of(met->face);
      if (!material.mirror) return sight;
      if (sight.mirrors == depth) return std::nullopt;
      sight.tint = sight.tint * material.reflectance;
      direction = normalize(direction - 2 * dot(direction, met->normal) * met->normal);
    }
  }

  // Estimates the light that arrives at a point, as a radiosity. The point reflects this light
  // multiplied by its reflectance.
  Rgb sample_irradiance(SurfacePoint point, Numbers& numbers) const {
    Rgb light, weight{1, 1, 1};
    for (;;) {
      light += weight * sample_emitters(point, numbers);
      const auto next = look_anywhere(point, numbers);
      if (!next) return light;
      const Material& material = material_of(next->point.face);
      weight = weight * next->tint;
      light += weight * eval_emission(*next, point);
      // Russian roulette: the path goes on with a probability equal to the largest reflectance.
      const double survival = max_component(material.reflectance);
      if (numbers.next() >= survival) return light;
      weight = (1 / survival) * weight * material.reflectance;
      point = next->point;
    }
  }

  // What is seen from a point in a random direction; the density is proportional to the cosine.
  std::optional<Sight> look_anywhere(const SurfacePoint& point, Numbers& numbers) const {
    const double u = numbers.next(), v = numbers.next();
    return look(point.at, sample_hemisphere(point.normal, u, v), point.face, MOST_MIRRORS);
  }

  // The emission of the surface that is seen from a point in a random direction. It is zero where
  // sample_emitters() counts this light already.
  Rgb eval_emission(const Sight& seen, const SurfacePoint& from) const {
    const Rgb& emission = material_of(seen.point.face).emission;
    const bool counts = seen.mirrors > 0 || is_near(seen.point, from.at);
    return counts ? emission : Rgb{};
  }

  // Estimates the light that arrives at a point directly from emitters that are not near.
  Rgb sample_emitters(const SurfacePoint& point, Numbers& numbers) const {
    const double which = numbers.next(), v = numbers.next();
    const auto found = std::ranges::upper_bound(emitters_, which, {}, &Emitter::until);
    const Emitter& e = found == emitters_.end() ? emitters_.back() : *found;
    const double u = std::clamp((which - (e.until - e.share)) / e.share, 0.0, 1.0);
    const double root = std::sqrt(u);
    const Vec at = (1 - root) * e.a + root * (1 - v) * e.b + root * v * e.c;
    if (e.face == point.face || is_near({at, {}, e.face}, point.at)) return {};
    const bool behind = dot(e.normal, point.at - at) < 0;
    if (behind && !e.two_sided) return {};
    const double density = eval_transfer(point, {at, behind ? -e.normal : e.normal, e.face});
    if (density <= 0 || geometry_.is_blocked(point, at, e.face)) return {};
    return (density * e.area / e.share) * e.emission;
  }

  // The probability density, per area, with which look_anywhere() finds the point `to` if nothing
  // hides it.
  static double eval_transfer(const SurfacePoint& point, const SurfacePoint& to) {
    const Vec way = to.at - point.at;
    const double square = dot(way, way);
    const double here = dot(point.normal, way), there = -dot(to.normal, way);
    return here > 0 && there > 0 ? here * there / (PI * square * square) : 0;
  }

  const RoomGeometry& geometry() const { return geometry_; }
  const Material& material_of(std::uint32_t face) const {
    return room_.materials[room_.faces[face].material];
  }

 private:
  // True if this point of an emitter counts as near: its light is found by rays in random
  // directions. Light from farther points is found by rays towards the emitter. With this division,
  // neither estimate can exceed the emission.
  bool is_near(const SurfacePoint& emitting, const Vec& from) const {
    const Vec way = emitting.at - from;
    return dot(way, way) < face_area_[emitting.face] / PI;
  }

  std::vector<double> make_face_areas() const {
    std::vector<double> areas(room_.faces.size());
    for (const Emitter& e : emitters_) areas[e.face] += e.area;
    return areas;
  }

  const Room& room_;
  const RoomGeometry geometry_;
  const std::vector<Emitter> emitters_;
  // area of each face that emits; 0 for all others
  const std::vector<double> face_area_ = make_face_areas();
};

// The standard error of the mean over all rounds.
double eval_error(std::span<const Rgb> rounds) {
  const auto n = static_cast<double>(rounds.size());
  double mean = 0, squares = 0;
  for (const Rgb& r : rounds) mean += sum(r) / 3 / n;
  for (const Rgb& r : rounds) squares += (sum(r) / 3 - mean) * (sum(r) / 3 - mean);
  return std::sqrt(squares / (n * (n - 1)));
}

// Computes the pixels of a picture in tiles. The light that a path from one pixel finds is used for
// all pixels of the tile that show the same face, weighted by the balance heuristic (P. Bekaert, M.
// Sbert and J. Halton, "Accelerating Path Tracing by Re-Using Paths", EGRW 2002).
class Painter {
 public:
  Painter(const Room& room, const TracerParams& params, const PictureParams& size)
      : params_(params),
        tracer_(room),
        view_(make_image_plane(room.view)),
        pixels_(make_pixels(size.width, size.height)),
        points_(make_points(std::max(1, params.samples / params.rounds))) {
    const auto count = static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height);
    made_.picture = {size.width, size.height, std::vector<Rgb>(count)};
    made_.error.resize(count);
    made_.faces.resize(count);
    emits_.resize(count);
  }

  Reference paint() {
    std::atomic<int> row = 0;
    const auto work = [&] {
      for (int y = TILE * row++; y < pixels_.height; y = TILE * row++)
        for (int x = 0; x < pixels_.width; x += TILE) paint_tile(x, y);
    };
    std::vector<std::jthread> threads;
    const auto hosts = static_cast<int>(std::thread::hardware_concurrency());
    for (int i = 1; i < (params_.threads > 0 ? params_.threads : hosts); ++i)
      threads.emplace_back(work);
    work();
    threads.clear();
    made_.emits.assign(emits_.begin(), emits_.end());
    return std::move(made_);
  }

 private:
  static constexpr int TILE = 8;      // width and height of a tile, pixels
  static constexpr int TO_LAMPS = 4;  // number of rays towards emitters at the start of each path

  struct Member {
    std::size_t pixel = 0;
    SurfacePoint point;
    Rgb tint;
  };
  using Group = std::vector<Member>;

  void paint_tile(int left, int top) {
    std::map<std::uint32_t, Group> groups;
    for (int y = top; y < std::min(top + TILE, pixels_.height); ++y)
      for (int x = left; x < std::min(left + TILE, pixels_.width); ++x) {
        const auto pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(pixels_.width) +
                           static_cast<std::size_t>(x);
        const renderer::Ray ray = make_primary(view_, pixels_, x, y);
        const auto seen = tracer_.look(tracer_.geometry().scale(ray.origin),
                                       normalize(ray.direction), NO_FACE, params_.depth);
        if (!seen) continue;
        made_.faces[pixel] = seen->number;
        groups[seen->number].push_back({pixel, seen->point, seen->tint});
      }
    for (const auto& [number, group] : groups) paint_group(group);
  }

  void paint_group(const Group& group) {
    const Material& material = tracer_.material_of(group.front().point.face);
    // by pixel of the group, then by round: the colour found in this round
    std::vector<std::vector<Rgb>> rounds(group.size());
    for (int round = 0; round < params_.rounds; ++round) {
      const auto light = find_irradiance(group, round);
      for (std::size_t k = 0; k < group.size(); ++k)
        rounds[k].push_back(group[k].tint * (material.emission + material.reflectance * light[k]));
    }
    for (std::size_t k = 0; k < group.size(); ++k) {
      const std::size_t pixel = group[k].pixel;
      emits_[pixel] = max_component(material.emission) > 0;
      for (const Rgb& found : rounds[k])
        made_.picture.pixels[pixel] += (1.0 / params_.rounds) * found;
      made_.error[pixel] = eval_error(rounds[k]);
    }
  }

  // The light that arrives at the pixels of a group, found by the paths of a round.
  std::vector<Rgb> find_irradiance(const Group& group, int round) const {
    std::vector<Rgb> light(group.size());
    for (std::size_t j = 0; j < group.size(); ++j) {
      const std::uint64_t key = base::random_at(base::random_at(params_.seed, group[j].pixel),
                                                static_cast<std::uint64_t>(round));
      for (std::size_t i = 0; i < points_.size(); ++i) {
        Numbers numbers(points_[i], key, i);
        add_path(group, j, numbers, light);
      }
    }
    for (Rgb& sum : light) sum = (1.0 / static_cast<double>(points_.size())) * sum;
    return light;
  }

  void add_path(const Group& group, std::size_t j, Numbers& numbers,
                std::vector<Rgb>& light) const {
    const SurfacePoint& start = group[j].point;
    for (int i = 0; i < TO_LAMPS; ++i)
      light[j] += (1.0 / TO_LAMPS) * tracer_.sample_emitters(start, numbers);
    const auto seen = tracer_.look_anywhere(start, numbers);
    if (!seen) return;
    const Rgb& reflectance = tracer_.material_of(seen->point.face).reflectance;
    const Rgb reflected = max_component(reflectance) > 0
                              ? reflectance * tracer_.sample_irradiance(seen->point, numbers)
                              : Rgb{};
    if (seen->mirrors > 0)
      light[j] += seen->tint * (reflected + tracer_.eval_emission(*seen, start));
    else
      share(group, j, *seen, reflected, light);
  }

  // Adds the light of a surface that is seen from pixel j to all pixels of the group that see it.
  void share(const Group& group, std::size_t j, const PathTracer::Sight& seen, const Rgb& reflected,
             std::vector<Rgb>& light) const {
    std::array<double, TILE * TILE> weights{};
    double sum = 0;
    for (std::size_t k = 0; k < group.size(); ++k) {
      const SurfacePoint& point = group[k].point;
      const double weight = PathTracer::eval_transfer(point, seen.point);
      const bool hidden = k != j && weight > 0 &&
                          tracer_.geometry().is_blocked(point, seen.point.at, seen.point.face);
      sum += weights[k] = hidden ? 0 : weight;
    }
    for (std::size_t k = 0; k < group.size(); ++k)
      if (weights[k] > 0)
        light[k] += weights[k] / sum * (reflected + tracer_.eval_emission(seen, group[k].point));
  }

  const TracerParams params_;
  const PathTracer tracer_;
  const renderer::View view_;
  const renderer::Params pixels_;
  const std::vector<Numbers::Point> points_;
  Reference made_;
  // not vector<bool>, whose neighbouring elements threads must not write at the same time
  std::vector<char> emits_;
};

}  // namespace

renderer::Params make_pixels(int width, int height) {
  renderer::Params pixels;
  pixels.width = width;
  pixels.height = height;
  pixels.sample = renderer::SamplePosition::center;
  return pixels;
}

Reference trace_paths(const Room& room, const TracerParams& params) {
  renderer::require(params.rounds >= 2, fmt::format("{} rounds", params.rounds), "2 or more");
  PictureParams size;
  size.width = params.width;
  size.height = params.height;
  return Painter(room, params, fit(size, room.view)).paint();
}

}  // namespace radiosity::reference
