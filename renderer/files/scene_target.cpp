#include "renderer/files/scene_target.hpp"

#include "renderer/image/image.hpp"
#include "renderer/scene/require.hpp"

namespace renderer {

namespace {

constexpr std::size_t MAX_LIGHTS = 65535;
constexpr double MAX_DISPLACEMENT = 1e15;  // the largest number that files may contain

Vec eval_displacement(const Motion& motion, double time) {
  return motion.path.empty() ? time * motion.velocity : eval_path(motion.path, time).place;
}

}  // namespace

void SceneTarget::set_view(const View& view) {
  scene_.view = view;
  if (camera_.empty()) view_line_ = line;
}

void SceneTarget::set_camera(Path path) {
  camera_ = std::move(path);
  view_line_ = line;
}

void SceneTarget::add_light(const Light& light, const std::optional<Rgb>& colour) {
  require(scene_.lights.size() < MAX_LIGHTS, "more lights", fmt::format("at most {}", MAX_LIGHTS));
  scene_.lights.push_back(light);
  scene_.lights.back().intensity = colour.value_or(Rgb{});
  has_colour_.push_back(colour.has_value());
}

void SceneTarget::set_surface(const Surface& surface) {
  scene_.surfaces.push_back(surface);
  objects_before_ = object_count(scene_);
}

void SceneTarget::change_surface(const Surface& surface) {
  if (object_count(scene_) > objects_before_)
    set_surface(surface);
  else
    scene_.surfaces.back() = surface;
}

void SceneTarget::set_motion(Motion motion) {
  motions_.push_back({std::move(motion), object_count(scene_), line});
}

std::uint32_t SceneTarget::add_texture(const std::string& file, const Mapping& mapping) {
  const auto [known, is_new] =
      pyramids_.try_emplace(file, static_cast<std::uint32_t>(scene_.pyramids.size()));
  if (is_new) {
    const Bitmap picture = load_png(file);
    scene_.pyramids.push_back(make_pyramid(picture.width, picture.height, picture.rgb8));
  }
  scene_.textures.push_back({known->second, mapping});
  return static_cast<std::uint32_t>(scene_.textures.size() - 1);
}

void SceneTarget::add_sphere(const Vec& centre, double radius) {
  renderer::add_sphere(scene_, centre, radius);
}

void SceneTarget::add_polygon(std::vector<Vec> corners, std::vector<Vec> normals) {
  if (normals.empty())
    renderer::add_polygon(scene_, corners, coordinates_);
  else
    add_patch(scene_, corners, normals, coordinates_);
}

void SceneTarget::add_cone(const Vec& base, double base_radius, const Vec& apex,
                           double apex_radius) {
  renderer::add_cone(scene_, base, base_radius, apex, apex_radius);
}

// Gives each light without a colour the intensity 1 / sqrt(number of lights), as the SPD specifies.
void SceneTarget::share_energy() {
  const double share =
      1 / std::sqrt(static_cast<double>(std::max<std::size_t>(1, scene_.lights.size())));
  for (std::size_t i = 0; i < scene_.lights.size(); ++i)
    if (!has_colour_[i]) scene_.lights[i].intensity = {share, share, share};
}

void SceneTarget::set_view_at(double open, double close) {
  View& view = scene_.view;
  view.lens = lens_;
  if (camera_.empty()) return;
  const PathRow first = eval_path(camera_, open), last = eval_path(camera_, close);
  view.from = first.place;
  view.at = first.target;
  view.from_move = last.place - first.place;
  view.at_move = last.target - first.target;
}

void SceneTarget::move_objects(double open, double close) {
  for (std::size_t i = 0; i < motions_.size(); ++i) {
    const auto& [motion, first, motion_line] = motions_[i];
    const std::size_t end = i + 1 < motions_.size() ? motions_[i + 1].first : object_count(scene_);
    const Vec before = eval_displacement(motion, open);
    const Vec move = eval_displacement(motion, close) - before;
    const double most = std::max(max_abs(before), max_abs(before + move));
    at_place(fmt::format("{}:{}", name_, motion_line), [&] {
      require(most <= MAX_DISPLACEMENT, fmt::format("a displacement of {:g}", most),
              fmt::format("at most {:g}", MAX_DISPLACEMENT));
    });
    if (move != Vec{}) scene_.moves.resize(object_count(scene_));
    for (std::size_t object = first; object < end; ++object) {
      translate(scene_, static_cast<std::uint32_t>(object), before);
      if (move != Vec{}) scene_.moves[object] = move;
    }
  }
}

Scene SceneTarget::make_scene(int frame) {
  share_energy();
  const double open = frame + shutter_.open, close = frame + shutter_.close;
  set_view_at(open, close);
  move_objects(open, close);
  at_place(fmt::format("{}:{}", name_, view_line_), [&] { finish(scene_); });
  return std::move(scene_);
}

}  // namespace renderer
