#include "simulator/iirra/sampler.hpp"

#include <algorithm>

namespace iirra {

using machine::this_process;
using renderer::Ray;

namespace {

Traced trace_ray(const renderer::Scene& scene, const renderer::Params& params, const Ray& ray,
                 renderer::Work& work, renderer::Access* access = nullptr) {
  Traced traced;
  traced.hit = intersect(scene, ray, params.traversal, work, access);
  if (ray.kind == renderer::RayKind::probe) return traced;
  traced.contribution = eval_contribution(scene, params, ray, traced.hit, work);
  if (traced.hit) make_children(scene, params, ray, *traced.hit, traced.children, work);
  return traced;
}

}  // namespace

Sampler::Sampler(Shared& shared, shared_memory::DataManager& manager, std::function<void()> serve)
    : shared_(shared),
      manager_(manager),
      params_(shared.params),
      sizes_(shared.sizes),
      serve_(std::move(serve)),
      samples_(params_.image.sampling) {}

void Sampler::begin(const Point& p) {
  const bool is_outside = shared_.is_outside(p);
  ++shared_.record.counts.samples;
  shared_.record.counts.samples_outside += is_outside;
  allocate(sizes_.sample, "samples");
  open_ = p;
  Sample& sample = samples_[p];
  trace(sample, make_primary(shared_.scene.view, params_.image, p.x, p.y), is_outside);
  if (!is_outside) extend(sample, p);
  open_.reset();
}

void Sampler::deepen(const Point& p, int pass, int level, const Limits& limits) {
  open_ = p;
  Sample& sample = samples_.at(p);
  const bool is_outside = shared_.is_outside(p);
  for (std::size_t i = 0; i < sample.waiting.size();) {
    const Ray ray = sample.waiting[i];
    if (ray.pass != pass || ray.level != level || !is_within(ray, limits)) {
      ++i;
      continue;
    }
    sample.waiting.erase(sample.waiting.begin() + static_cast<std::ptrdiff_t>(i));
    own_memory().release(sizes_.ray);
    trace(sample, ray, is_outside);
  }
  if (!is_outside) extend(sample, p);
  open_.reset();
}

void Sampler::measure(const Point& p) {
  Sample sample;
  sample.waiting = {make_primary(shared_.scene.view, params_.image, p.x, p.y)};
  while (!sample.waiting.empty()) {
    const Ray ray = sample.waiting.back();
    sample.waiting.pop_back();
    for (const Ray& child : shoot(sample, ray, shared_.is_outside(p)).children)
      sample.waiting.push_back(child);
  }
  ++shared_.record.counts.samples;
  shared_.record.counts.samples_outside += shared_.is_outside(p);
}

// Traces a ray, then the shadow feelers (rays to the lights) that start at its hit. Queues all
// other child rays.
void Sampler::trace(Sample& sample, const Ray& ray, bool is_outside) {
  const auto& sampling = params_.image.sampling;
  const bool is_judged = is_adaptive(sampling) && !is_outside;
  if (ray.level == 1 && sample.begun++ == 0) sample.open = renderer::OpenPixel(sampling);
  const auto keep = [&](const Ray& shot, const Traced& traced) {
    if (!is_judged) return;
    if (shot.level == 1) allocate(sizes_.pixel, "samples of pixels");
    sample.open.add(shot, traced.hit, traced.contribution);
  };
  const Traced traced = shoot(sample, ray, is_outside);
  keep(ray, traced);
  for (const Ray& child : traced.children)
    if (child.kind == renderer::RayKind::shadow) {
      keep(child, shoot(sample, child, is_outside));
    } else {
      allocate(sizes_.ray, "waiting rays");
      sample.waiting.push_back(child);
    }
}

// Queues the primary ray of the pixel's next sample, if one is needed and the primary ray of the
// previous sample has been traced.
void Sampler::extend(Sample& sample, const Point& p) {
  const auto& sampling = params_.image.sampling;
  if (sampling.pixel_samples == 1) return;
  const bool is_primary_waiting =
      std::ranges::any_of(sample.waiting, [](const Ray& ray) { return ray.level == 1; });
  if (is_primary_waiting) return;
  const int wanted = is_adaptive(sampling) ? find_wanted(sample, p) : sampling.pixel_samples;
  if (sample.begun >= wanted) return;
  allocate(sizes_.ray, "waiting rays");
  sample.waiting.push_back(make_primary(shared_.scene.view, params_.image, p.x, p.y, sample.begun));
}

// Only for adaptive sampling: returns the number of samples that the pixel needs. After each round
// of samples, finds the objects at the pixel's corners and decides anew.
int Sampler::find_wanted(Sample& sample, const Point& p) {
  auto& open = sample.open;
  if (sample.begun < open.wanted || !sample.waiting.empty() || open.samples.empty())
    return open.wanted;
  renderer::Corners corners;
  for (int i = 0; i < 4; ++i) {
    const Ray probe = make_probe(shared_.scene.view, params_.image, p.x + i % 2, p.y + i / 2);
    const auto [corner, is_new] = corners_.try_emplace(probe.path, renderer::NO_OBJECT);
    if (is_new) {
      Sample nothing;
      const auto hit = shoot(nothing, probe, false).hit;
      corners_[probe.path] = hit ? hit->object : renderer::NO_OBJECT;
    }
    corners[static_cast<std::size_t>(i)] = corners_[probe.path];
  }
  open.wanted = renderer::find_wanted(params_.image.sampling, open.samples, corners);
  if (open.wanted == sample.begun) {
    sample.sums =
        repeat(eval_estimate(params_.image.sampling, open.samples, corners), sample.begun);
    own_memory().release(sizes_.pixel * open.samples.size());
    open.samples.clear();
  }
  return open.wanted;
}

Traced Sampler::shoot(Sample& sample, const Ray& ray, bool is_outside) {
  serve_();
  const auto& scene = shared_.scene;
  const auto& params = params_.image;
  Traced traced;
  if (!shared_.items) {
    traced = shared_.ray_cost([&scene, &params, ray](renderer::Work& work) {
      return trace_ray(scene, params, ray, work);
    });
  } else {
    const double scale = shared_.ray_cost.eval_scale(
        shared_.scratch, [&scene, &params, ray](Traced& to, auto& work) {
          to = trace_ray(scene, params, ray, work);
        });
    shared_memory::SceneReader reader(*shared_.items, manager_, shared_.ray_cost.counted(), scale);
    renderer::Work work;
    traced = trace_ray(scene, params, ray, work, &reader);
    reader.charge(work);
    shared_.charged_with_data += reader.charged();
    shared_.charged_with_data_s += this_process().processor().duration(reader.charged());
  }
  const bool is_hit = traced.hit.has_value();
  add(sample.sums, traced.contribution);
  sample.rays.add(ray.kind, is_hit);
  shared_.record.rays.add(ray.kind, is_hit);
  if (is_outside) shared_.record.rays_outside.add(ray.kind, is_hit);
  return traced;
}

}  // namespace iirra
