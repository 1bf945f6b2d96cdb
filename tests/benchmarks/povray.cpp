#include <cmath>
#include <cstdlib>
#include <filesystem>
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

std::string lens(const renderer::View& v, int samples) {
  if (!(v.lens.aperture > 0)) return "";
  const Vec focal_point = v.from + v.lens.focus * normalize(v.at - v.from);
  return fmt::format(" focal_point {} aperture {:.17g} blur_samples {} variance 0 confidence 0.99",
                     text(focal_point), v.lens.aperture, samples);
}

std::string area(const renderer::Light& light, int side) {
  if (light.shape == renderer::LightShape::point) return "";
  if (light.shape != renderer::LightShape::rectangle)
    throw std::runtime_error("povray: its lights that are spheres are made otherwise");
  return fmt::format(" area_light {}, {}, {}, {} jitter", text(2.0 * light.u), text(2.0 * light.v),
                     side, side);
}

// Writes the scene for POV-Ray. POV-Ray's axes are left-handed and tlab's right-handed, hence
// `right -x`.
void save_scene(const Scene& scene, const renderer::Params& params, const PovraySamples& samples,
                const std::string& path) {
  std::ofstream out(path);
  const renderer::View& v = scene.view;
  out << fmt::format(
      "#version 3.7;\nglobal_settings {{ assumed_gamma 1 max_trace_level {} "
      "adc_bailout {} }}\nbackground {{ {} }}\n",
      params.limits.depth, params.limits.min_influence, text(scene.background));
  out << fmt::format("camera {{ location {} sky {} up z right -x angle {} look_at {}{} }}\n",
                     text(v.from), text(v.up), v.angle, text(v.at), lens(v, samples.lens));
  for (const auto& light : scene.lights)
    out << fmt::format("light_source {{ {} {}{} }}\n", text(light.at), text(light.intensity),
                       area(light, samples.light_side));
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

// The number that follows `label` in the statistics that POV-Ray prints.
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

// Loads a PPM image with 16 bits for each colour.
renderer::Samples load_image(const std::string& path, const renderer::Params& params) {
  renderer::Samples image(params.width, params.height);
  const std::string file = read_file(path);
  const std::size_t bytes = 6 * image.sums.size();
  if (!file.starts_with("P6") || file.size() < bytes)
    throw std::runtime_error("povray: no image in " + path);
  std::size_t at = file.size() - bytes;
  const auto read = [&] {
    const auto high = static_cast<std::uint8_t>(file[at]),
               low = static_cast<std::uint8_t>(file[at + 1]);
    at += 2;
    return (256 * high + low) / 65535.0;
  };
  for (std::uint32_t i = 0; i < image.sums.size(); ++i) {
    const double r = read(), g = read(), b = read();
    image.add(i, {r, g, b});
  }
  return image;
}

class Folder {
 public:
  Folder() {
    path_ = (std::filesystem::temp_directory_path() / "tlab-XXXXXX").string();
    if (!mkdtemp(path_.data())) throw std::runtime_error("cannot make " + path_);
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace

const std::string& temporary_folder() {
  static const Folder folder;
  return folder.path();
}

PovrayRun run_povray(const Scene& scene, const renderer::Params& params,
                     const PovraySamples& samples, const std::string& folder) {
  const std::string path = folder + "/view";
  save_scene(scene, params, samples, path + ".pov");
  const std::string command = fmt::format(
      "povray +I{0}.pov +O{0}.ppm +FP16 File_Gamma=1.0 +W{1} +H{2} -A -J -D -V -P +WT1 +MB0 "
      ">{0}.log 2>&1 </dev/null",
      path, params.width, params.height);
  if (std::system(command.c_str()) != 0)
    throw std::runtime_error("povray failed:\n" + read_file(path + ".log"));
  const std::string log = read_file(path + ".log");
  const double rays = number_after(log, "Rays:") + number_after(log, "Shadow Ray Tests:");
  return {{static_cast<std::uint64_t>(rays), number_after(log, "Trace Time:", "with ")},
          load_image(path + ".ppm", params)};
}

}  // namespace benchmarks
