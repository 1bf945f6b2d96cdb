#include "renderer/files/nff.hpp"

#include <algorithm>
#include <functional>

#include "base/text.hpp"
#include "base/whole_file.hpp"
#include "renderer/files/tokens.hpp"
#include "renderer/scene/generators.hpp"
#include "renderer/scene/require.hpp"

namespace renderer {

namespace {

constexpr int MAX_LIGHTS = 65535, MAX_VERTICES = 1 << 24;
constexpr double MAX_SHINE = 1e9, MAX_IOR = 1e6, MAX_COLOUR = 1000;

class Reader {
 public:
  Reader(std::string_view text, const std::string& name, NffTarget& target)
      : tokens_(text, name, target.takes_emission() ? "emit" : ""), target_(target) {}

  int read() {
    while (!tokens_.peek().empty()) read_statement();
    if (view_line_ == 0) tokens_.fail_next("a view ('v')");
    return view_line_;
  }

 private:
  void read_statement() {
    using Read = void (*)(Reader&);
    constexpr std::pair<std::string_view, Read> STATEMENTS[] = {
        {"v", [](Reader& r) { r.read_view(); }},
        {"b", [](Reader& r) { r.target_.set_background(r.take_colour("the background")); }},
        {"l", [](Reader& r) { r.read_light(); }},
        {"f", [](Reader& r) { r.read_surface(); }},
        {"s", [](Reader& r) { r.read_sphere(); }},
        {"p", [](Reader& r) { r.read_corners(false); }},
        {"pp", [](Reader& r) { r.read_corners(true); }},
        {"c", [](Reader& r) { r.read_cone(); }}};
    const std::string_view name = tokens_.peek();
    if (target_.takes_emission() && tokens_.take_if("emit")) return read_emission();
    const Read read = tokens_.take_choice(
        STATEMENTS, target_.takes_emission() ? "a statement: v, b, l, f, # emit, p or pp"
                                             : "a statement: v, b, l, f, s, p, pp or c");
    target_.line = tokens_.line();
    if (name == "s" || name == "p" || name == "pp" || name == "c") require_surface(name);
    read(*this);
  }

  template <class Action>
  void tell(const Action& action) {
    tokens_.at_line(target_.line, action);
  }

  void require_surface(std::string_view statement) {
    if (!has_surface_)
      tokens_.fail(target_.line,
                   fmt::format("found '{}', expected a surface ('f') before it", statement));
  }

  Rgb take_colour(std::string_view what) {
    const auto take = [&] { return tokens_.take_number(what, 0, MAX_COLOUR); };
    const double r = take(), g = take();
    return {r, g, take()};
  }

  void read_view() {
    if (view_line_ != 0)
      tokens_.fail(target_.line,
                   fmt::format("found a second 'v', expected one, that of line {}", view_line_));
    view_line_ = target_.line;
    const View view = take_view();
    tell([&] { target_.set_view(view); });
  }

  View take_view() {
    View view;
    const std::pair<std::string_view, std::function<void()>> settings[] = {
        {"from", [&] { view.from = tokens_.take_vec("from"); }},
        {"at", [&] { view.at = tokens_.take_vec("at"); }},
        {"up", [&] { view.up = tokens_.take_vec("up"); }},
        {"angle", [&] { view.angle = tokens_.take_number("angle", 0, 180); }},
        {"hither", [&] { view.hither = tokens_.take_number("hither", 0, MAX_NUMBER); }},
        {"resolution", [&] {
           view.width = tokens_.take_count("the resolution's width", 1, MAX_SIDE);
           view.height = tokens_.take_count("the resolution's height", 1, MAX_SIDE);
         }}};
    constexpr std::size_t REQUIRED = 4;  // hither and resolution have defaults
    bool seen[std::size(settings)] = {};
    for (;;) {
      const auto* setting = std::ranges::find(settings, tokens_.peek(),
                                              [](const auto& named) { return named.first; });
      if (setting == std::end(settings)) break;
      if (std::exchange(seen[setting - settings], true))
        tokens_.fail_next("each of the view's settings once");
      tokens_.take();
      setting->second();
    }
    for (std::size_t i = 0; i < REQUIRED; ++i)
      if (!seen[i]) tokens_.fail_next(fmt::format("the view's '{}'", settings[i].first));
    return view;
  }

  void read_light() {
    const Vec at = tokens_.take_vec("the light's position");
    std::optional<Rgb> colour;
    if (tokens_.continues()) colour = take_colour("the light's colour");
    tell([&] { target_.add_light(at, colour); });
  }

  void read_surface() {
    Surface s;
    s.colour = take_colour("the surface's colour");
    s.kd = tokens_.take_number("Kd", 0, 1);
    s.ks = tokens_.take_number("Ks", 0, 1);
    s.shine = tokens_.take_number("Shine", 0, MAX_SHINE);
    s.t = tokens_.take_number("T", 0, 1);
    const double ior = tokens_.take_number("the index of refraction", 0, MAX_IOR);
    if (ior > 0)
      s.ior = ior;
    else if (s.t > 0)  // files give 0 to what is opaque
      tokens_.fail(tokens_.line(),
                   "found an index of refraction of 0, expected one > 0 where T > 0");
    has_surface_ = true;
    tell([&] { target_.set_surface(s); });
  }

  void read_emission() {
    target_.line = tokens_.line();
    require_surface("# emit");
    const Rgb emission = tokens_.take_rgb("an emission");
    tell([&] { target_.set_emission(emission); });
  }

  void read_sphere() {
    const Vec centre = tokens_.take_vec("the centre");
    const double radius = tokens_.take_number("the radius", 0, MAX_NUMBER);
    tell([&] { target_.add_sphere(centre, radius); });
  }

  void read_corners(bool with_normals) {
    const int count = tokens_.take_count("the number of vertices", 3, MAX_VERTICES);
    std::vector<Vec> corners, normals;
    for (int i = 0; i < count; ++i) {
      corners.push_back(tokens_.take_vec("a vertex"));
      if (with_normals) normals.push_back(tokens_.take_vec("a normal"));
    }
    tell([&] { target_.add_polygon(std::move(corners), std::move(normals)); });
  }

  void read_cone() {
    const Vec base = tokens_.take_vec("the base");
    const double base_radius = tokens_.take_number("the base's radius", 0, MAX_NUMBER);
    const Vec apex = tokens_.take_vec("the apex");
    const double apex_radius = tokens_.take_number("the apex's radius", 0, MAX_NUMBER);
    tell([&] { target_.add_cone(base, base_radius, apex, apex_radius); });
  }

  Tokens tokens_;
  NffTarget& target_;
  int view_line_ = 0;
  bool has_surface_ = false;
};

// A scene, but for what finish() does.
struct SceneTarget : NffTarget {
  Scene scene;
  std::vector<bool> has_colour;  // by light

  void set_view(const View& view) override { scene.view = view; }
  void set_background(const Rgb& colour) override { scene.background = colour; }
  void add_light(const Vec& at, const std::optional<Rgb>& colour) override {
    require(scene.lights.size() < MAX_LIGHTS, "more lights", fmt::format("at most {}", MAX_LIGHTS));
    scene.lights.push_back({at, colour.value_or(Rgb{})});
    has_colour.push_back(colour.has_value());
  }
  void set_surface(const Surface& surface) override { scene.surfaces.push_back(surface); }
  void add_sphere(const Vec& centre, double radius) override {
    renderer::add_sphere(scene, centre, radius);
  }
  void add_polygon(std::vector<Vec> corners, std::vector<Vec> normals) override {
    if (normals.empty())
      renderer::add_polygon(scene, corners);
    else
      add_patch(scene, corners, normals);
  }
  void add_cone(const Vec& base, double base_radius, const Vec& apex, double apex_radius) override {
    renderer::add_cone(scene, base, base_radius, apex, apex_radius);
  }
};

}  // namespace

int read_nff(std::string_view text, const std::string& name, NffTarget& target) {
  return Reader(text, name, target).read();
}

Scene parse_nff(std::string_view text, const std::string& name) {
  SceneTarget target;
  const int view_line = read_nff(text, name, target);
  Scene& scene = target.scene;
  // SPD: all lights together have the same energy, however many there are.
  const double share =
      1 / std::sqrt(static_cast<double>(std::max<std::size_t>(1, scene.lights.size())));
  for (std::size_t i = 0; i < scene.lights.size(); ++i)
    if (!target.has_colour[i]) scene.lights[i].intensity = {share, share, share};
  at_place(fmt::format("{}:{}", name, view_line), [&] { finish(scene); });
  return std::move(scene);
}

Scene load_scene(const std::string& source) {
  if (source.ends_with(".nff")) return parse_nff(base::read_text(source), source);
  std::vector<std::string> forms;
  for (const auto& [name, number, least, most, make] : GENERATORS) {
    const auto prefix = fmt::format("{}:", name);
    forms.push_back(prefix + std::string(number));
    if (!source.starts_with(prefix)) continue;
    if (const auto n = base::parse_number<int>(source.substr(prefix.size()))) return make(*n);
    throw base::BadInput(fmt::format("found scene {}, expected {} with {} from {} to {}",
                                     base::quote(source), forms.back(), number, least, most));
  }
  throw base::BadInput(fmt::format("found scene {}, expected a generator ({}) or a file (.nff)",
                                   base::quote(source), fmt::join(forms, ", ")));
}

}  // namespace renderer
