#include "renderer/radiosity/light/receivers.hpp"

#include "renderer/radiosity/light/mirrors.hpp"
#include "renderer/trace/shadow_rays.hpp"

namespace radiosity {

using renderer::count;
using renderer::holds_any;
using renderer::Lanes;
using renderer::LANES;
using renderer::Mask;
using renderer::Op;
using renderer::Vecs;
using renderer::Work;

namespace {

// The vertices that receive light, one per SIMD lane. A lane without a vertex has the position of
// the first vertex, and is not `present`.
struct Points {
  [[gnu::always_inline]] explicit Points(const Receivers& receivers) {
    const Vertex& first = *receivers[0];
    const auto get = [&](std::size_t k) -> const Vertex& {
      return receivers[k] ? *receivers[k] : first;
    };
    const Vertex &second = get(1), &third = get(2), &fourth = get(3);
    const auto gather = [&](Vec Vertex::*point) __attribute__((always_inline)) {
      const Vec &e = first.*point, &f = second.*point, &g = third.*point, &h = fourth.*point;
      return Vecs{{e.x, f.x, g.x, h.x}, {e.y, f.y, g.y, h.y}, {e.z, f.z, g.z, h.z}};
    };
    at = gather(&Vertex::lit);
    normal = gather(&Vertex::normal);
    object = Mask{first.object, second.object, third.object, fourth.object};
    present = Mask{-1, -(receivers[1] != nullptr), -(receivers[2] != nullptr),
                   -(receivers[3] != nullptr)};
  }
  Vecs at, normal;
  Mask object, present;
};

// The result of face_each_other() for each lane.
[[gnu::always_inline]] inline Mask find_facing(const Points& points, const Patch& patch) {
  Mask before{};
  for (const Vec& corner : patch.at) before |= dot(corner - points.at, points.normal) > 0.0;
  return points.present & before & (dot(points.at - patch.centre, patch.normal) > 0.0);
}

// The lanes of `looking` whose line of sight to a point of the patch is not blocked: sees() for
// each lane.
[[gnu::always_inline]] inline Mask find_seeing(const Eye& eye, const Points& points,
                                               const Patch& patch, const Mask& looking,
                                               const Vecs& way, const Lanes& square, Work& work) {
  const Lanes distance = renderer::sqrt(square);
  renderer::ShadowRays rays;
  rays.origin = points.at;
  rays.direction = (1.0 / distance) * way;
  rays.reach = distance * NEARLY;
  rays.from = points.object;
  rays.cast = looking & (points.object != static_cast<std::int64_t>(patch.object));
  find_blocked(eye.mesh.blockers, rays, work);
  return looking & ~rays.blocked;
}

// Delta areas that face the receivers: one per lane, or one shared by all lanes.
template <class Share>
struct Looks {
  DeltaOf<Share> delta;
  Vecs way;  // `way` and the next three members are those of Look
  Lanes square, here, there;
  Mask looking;
};

// Terms in SIMD lanes. LaneRecorder is a `source` that makes them, as TermCollector does for one
// point.
struct TermLanes {
  Lanes share, s, t;
};
struct LaneRecorder {
  struct Place {
    Lanes s, t;
    [[gnu::always_inline]] friend TermLanes operator*(const Lanes& share, const Place& at) {
      return {share, at.s, at.t};
    }
  };
  [[gnu::always_inline]] Place eval(const Lanes& s, const Lanes& t) const { return {s, t}; }
};

// Sums of the light at the receivers. `kept`, unless null, receives their terms instead.
struct Sum {
  Lights lights{};
  TermsLanes* kept = nullptr;
};

// Adds the terms of the visible delta areas to the sums. The terms equal those of eval_seen() for
// delta areas that are not wide. `receiver(k)` is the index of the receiver in lane k.
template <class Share, class Receiver>
[[gnu::always_inline]] inline void add_terms(const Eye& eye, const Sender& sender,
                                             const Points& points, const Looks<Share>& looks,
                                             const Receiver& receiver, Sum& sum, Work& work) {
  const auto& [patch, quad, glow, is_even] = sender;
  const auto& [delta, way, square, here, there, looking] = looks;
  const Mask seeing = find_seeing(eye, points, patch, looking, way, square, work);
  if (!holds_any(seeing)) return;
  const DeltaSize size(quad, delta);
  const Rise<Lanes> rise{dot(points.normal, quad.a), dot(points.normal, quad.b),
                         dot(points.normal, quad.c)};
  if (sum.kept) {
    const TermLanes terms =
        eval_far(quad, delta, size, rise, way, square, here, there, LaneRecorder{});
    work[Op::glow_found] += count(seeing);
    for (std::size_t k = 0; k < LANES; ++k)
      if (seeing[k])
        (*sum.kept)[receiver(k)].terms.push_back({terms.share[k], terms.s[k], terms.t[k]});
    return;
  }
  renderer::Rgbs terms;
  if (is_even) {
    terms = eval_far(quad, delta, size, rise, way, square, here, there, EvenGlow{glow.at});
  } else {
    terms = eval_far(quad, delta, size, rise, way, square, here, there, glow);
    work[Op::glow_found] += count(seeing);
  }
  for (std::size_t k = 0; k < LANES; ++k)
    if (seeing[k]) sum.lights[receiver(k)] += Rgb{terms.r[k], terms.g[k], terms.b[k]};
}

// Adds the direct light at the receivers for which the patch is a single delta area that is not
// wide. Sets `near` for all other receivers that face the patch.
[[gnu::always_inline]] inline void add_far_lanes(const Eye& eye, const Receivers& receivers,
                                                 const Sender& sender, Sum& sum, Mask& near,
                                                 Work& work) {
  const auto& quad = sender.quad;
  const Points points(receivers);
  const Mask facing = find_facing(points, sender.patch);
  work[Op::factor_begun] += count(points.present);
  near = Mask{};
  if (!holds_any(facing)) return;
  const Cut cut = direct_cut(eye, sender);
  if (cut.samples > 1) {
    near = facing;
    return;
  }
  Looks<double> looks;
  looks.delta = {0.5, 0.5, 1, 1};
  looks.way = find_aim(quad, looks.delta) - points.at;
  looks.square = dot(looks.way, looks.way);
  const DeltaSize size(quad, looks.delta);
  near = facing & (std::max(size.square_a, size.square_b) > looks.square);
  if (cut.halvings > 0)
    near |= facing & (std::max(quad.along, quad.across) > cut.enough * looks.square);
  work[Op::delta_area] += count(facing & ~near);
  looks.here = dot(looks.way, points.normal);
  looks.there = -dot(looks.way, quad.normal);
  looks.looking = facing & ~near & (looks.here > 0.0) & (looks.there > 0.0);
  if (holds_any(looks.looking))
    add_terms(
        eye, sender, points, looks, [](std::size_t k) { return k; }, sum, work);
}

// A delta area as seen by one receiver.
struct Seen {
  const Vertex* vertex;
  std::size_t receiver;
  Delta delta;
  Look look;
};
using SeenLanes = std::array<Seen, LANES>;

[[gnu::always_inline]] inline void add_near_lanes(const Eye& eye, const SeenLanes& seen,
                                                  const Sender& sender, Sum& sum, Work& work) {
  const Points points({seen[0].vertex, seen[1].vertex, seen[2].vertex, seen[3].vertex});
  const auto gather = [&](const auto& of) __attribute__((always_inline)) {
    return Lanes{of(seen[0]), of(seen[1]), of(seen[2]), of(seen[3])};
  };
  Looks<Lanes> looks;
  looks.delta = {gather([](const Seen& s) { return s.delta.s; }),
                 gather([](const Seen& s) { return s.delta.t; }),
                 gather([](const Seen& s) { return s.delta.along; }),
                 gather([](const Seen& s) { return s.delta.across; })};
  looks.way = {gather([](const Seen& s) { return s.look.way.x; }),
               gather([](const Seen& s) { return s.look.way.y; }),
               gather([](const Seen& s) { return s.look.way.z; })};
  looks.square = gather([](const Seen& s) { return s.look.square; });
  looks.here = gather([](const Seen& s) { return s.look.here; });
  looks.there = gather([](const Seen& s) { return s.look.there; });
  looks.looking = points.present;
  add_terms(
      eye, sender, points, looks, [&](std::size_t k) { return seen[k].receiver; }, sum, work);
}

// Collects delta areas seen by receivers, and evaluates them when all lanes are full.
class Near {
 public:
  Near(const Eye& eye, const Sender& sender, Sum& sum, Work& work)
      : eye_(eye), sender_(sender), sum_(sum), work_(work) {}

  // Adds the direct light at a vertex that faces the patch. Some terms remain pending until
  // flush().
  void add(const Vertex& vertex, std::size_t receiver) {
    const Viewpoint view{vertex.lit, vertex.normal};
    const auto misses = [](const Vec&, double) { return false; };
    const auto take = [&](const Delta& delta, const Look& look) {
      if (is_wide({sender_.quad, delta}, look.square))
        return add_wide(vertex, receiver, delta, look);
      seen_[count_++] = {&vertex, receiver, delta, look};
      if (count_ == LANES) flush();
    };
    Cutter(direct_cut(eye_, sender_), view, sender_.quad, misses, take, work_).run();
  }
  void flush() {
    if (count_ == 0) return;
    for (std::size_t k = count_; k < LANES; ++k) {
      seen_[k] = seen_[0];
      seen_[k].vertex = nullptr;
    }
    renderer::run_in_lanes([&]() __attribute__((always_inline)) {
      add_near_lanes(eye_, seen_, sender_, sum_, work_);
    });
    count_ = 0;
  }

 private:
  void add_wide(const Vertex& vertex, std::size_t receiver, const Delta& delta, const Look& look) {
    flush();  // evaluates pending terms first, so that the order of the sum stays the same
    const auto& [patch, quad, glow, is_even] = sender_;
    if (!sees(eye_, vertex.lit, vertex.object, look.point, patch.object, work_)) return;
    const auto eval = [&](const auto& source) {
      return eval_seen(quad, delta, vertex.normal, look, source, work_);
    };
    if (sum_.kept)
      eval(TermCollector{(*sum_.kept)[receiver]});
    else
      sum_.lights[receiver] += is_even ? eval(EvenGlow{glow.at}) : eval(glow);
  }

  const Eye& eye_;
  const Sender& sender_;
  Sum& sum_;
  Work& work_;
  SeenLanes seen_;
  std::size_t count_ = 0;
};

template <class F>
void for_each(const Receivers& receivers, const F& f) {
  for (std::size_t k = 0; k < LANES && receivers[k]; ++k) f(*receivers[k], k);
}

void add_direct_lights(const Eye& eye, const Receivers& receivers, const Sender& sender, Sum& sum,
                       Work& work) {
  Mask near;
  renderer::run_in_lanes([&]() __attribute__((always_inline)) {
    add_far_lanes(eye, receivers, sender, sum, near, work);
  });
  if (!holds_any(near)) return;
  Near rest(eye, sender, sum, work);
  for_each(receivers, [&](const Vertex& v, std::size_t k) {
    if (near[k]) rest.add(v, k);
  });
  rest.flush();
}

}  // namespace

Lights eval_lights(const Eye& eye, const Receivers& receivers, const Sender& sender, Work& work) {
  Sum sum;
  if (!are_in_lanes(eye)) {
    for_each(receivers, [&](const Vertex& v, std::size_t k) {
      sum.lights[k] = eval_light(eye, v, sender, work);
    });
    return sum.lights;
  }
  add_direct_lights(eye, receivers, sender, sum, work);
  if (has_mirrors(eye))
    for_each(receivers, [&](const Vertex& v, std::size_t k) {
      sum.lights[k] += eval_mirrored_light(eye, v, sender, work);
    });
  return sum.lights;
}

TermsLanes find_terms(const Eye& eye, const Receivers& receivers, const Sender& sender,
                      Work& work) {
  TermsLanes kept;
  Sum sum{.kept = &kept};
  add_direct_lights(eye, receivers, sender, sum, work);
  if (has_mirrors(eye))
    for_each(receivers, [&](const Vertex& v, std::size_t k) {
      find_mirrored_terms(eye, v, sender, kept[k], work);
    });
  return kept;
}

}  // namespace radiosity
