#include <cmath>
#include <cstdlib>
#include <sstream>

#include "tests/benchmarks/renderers.hpp"

namespace benchmarks {

using renderer::Rgb;
using renderer::Scene;
using renderer::Vec;

namespace {

std::string text(const Vec& v) { return fmt::format("<{:.17g}, {:.17g}, {:.17g}>", v.x, v.y, v.z); }
std::string text(const Rgb& c) {
  return fmt::format("rgb <{:.17g}, {:.17g}, {:.17g}>", c.r, c.g, c.b);
}

std::string texture(const renderer::Surface& s, double ambient) {
  return fmt::format(
      "texture {{ pigment {{ {} }} finish {{ ambient {} diffuse {} phong {} phong_size {} "
      "reflection {} }} }}",
      text(s.colour), ambient * s.kd, s.kd, s.ks, s.shine, s.ks);
}

// The axes are right-handed, POV-Ray's are not: hence `right -x`.
void save_scene(const Scene& scene, const renderer::Params& params, const std::string& path) {
  std::ofstream out(path);
  const renderer::View& v = scene.view;
  out << fmt::format(
      "#version 3.7;\nglobal_settings {{ assumed_gamma 1 max_trace_level {} "
      "adc_bailout {} }}\nbackground {{ {} }}\n",
      params.limits.depth, params.limits.min_influence, text(scene.background));
  out << fmt::format("camera {{ location {} sky {} up z right -x angle {} look_at {} }}\n",
                     text(v.from), text(v.up), v.angle, text(v.at));
  for (const auto& light : scene.lights)
    out << fmt::format("light_source {{ {} {} }}\n", text(light.at), text(light.intensity));
  for (std::size_t i = 0; i < scene.surfaces.size(); ++i)
    out << fmt::format("#declare T{} = {}\n", i, texture(scene.surfaces[i], params.ambient));
  for (const auto& p : scene.polygons) {
    out << fmt::format("polygon {{ {}", p.count + 1);
    for (std::uint32_t i = 0; i <= p.count; ++i) {
      const auto& c = scene.corners[p.first + i % p.count];
      double at[3];
      at[p.u] = c.u;
      at[p.v] = c.v;
      at[p.w] = (p.offset - p.normal[p.u] * c.u - p.normal[p.v] * c.v) / p.normal[p.w];
      out << ", " << text(Vec{at[0], at[1], at[2]});
    }
    out << fmt::format(" texture {{ T{} }} }}\n", p.tag.surface);
  }
  for (const auto& s : scene.spheres)
    out << fmt::format("sphere {{ {}, {:.17g} texture {{ T{} }} }}\n", text(s.centre), s.radius,
                       s.tag.surface);
  if (!out.flush()) throw std::runtime_error("cannot write " + path);
}

// The number after `label` in POV-Ray's statistics.
double number_after(const std::string& log, const std::string& label, const char* before = "") {
  const auto line = log.find(label);
  const auto at = log.find(before, line);
  if (line == log.npos || at == log.npos)
    throw std::runtime_error("povray: no '" + label + "' among its statistics:\n" + log);
  return std::strtod(log.c_str() + at + (*before ? std::string(before) : label).size(), nullptr);
}

std::string read_file(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream all;
  all << in.rdbuf();
  return all.str();
}

void compare(const renderer::Samples& ours, const std::string& path, PovrayRun& run) {
  const std::vector<std::uint8_t> a = make_rgb8(ours);
  const std::string file = read_file(path);
  if (!file.starts_with("P6") || file.size() < a.size())
    throw std::runtime_error("povray: no image in " + path);
  const std::string b = file.substr(file.size() - a.size());
  double sum = 0, differing = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const int apart = std::abs(a[i] - static_cast<std::uint8_t>(b[i]));
    sum += apart;
    differing += apart > 8 ? 1 : 0;
  }
  run.difference = sum / static_cast<double>(a.size());
  run.differing = differing / static_cast<double>(a.size());
}

}  // namespace

PovrayRun run_povray(const Scene& scene, const renderer::Params& params,
                     const renderer::Samples& ours, const std::string& folder) {
  const std::string path = folder + "/view";
  save_scene(scene, params, path + ".pov");
  const std::string command = fmt::format(
      "povray +I{0}.pov +O{0}.ppm +FP8 File_Gamma=1.0 +W{1} +H{2} -A -J -D -V -P +WT1 +MB0 "
      ">{0}.log 2>&1 </dev/null",
      path, params.width, params.height);
  if (std::system(command.c_str()) != 0)
    throw std::runtime_error("povray failed:\n" + read_file(path + ".log"));
  const std::string log = read_file(path + ".log");
  const double rays = number_after(log, "Rays:") + number_after(log, "Shadow Ray Tests:");
  PovrayRun run;
  run.sample = {static_cast<std::uint64_t>(rays), number_after(log, "Trace Time:", "with ")};
  compare(ours, path + ".ppm", run);
  return run;
}

}  // namespace benchmarks
