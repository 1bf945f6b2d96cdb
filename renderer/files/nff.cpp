#include "renderer/files/nff.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <functional>

#include "base/text.hpp"
#include "base/whole_file.hpp"
#include "renderer/files/scene_target.hpp"
#include "renderer/files/tokens.hpp"
#include "renderer/scene/generators.hpp"
#include "renderer/scene/require.hpp"

namespace renderer {

namespace {

constexpr int MAX_VERTICES = 1 << 24;
constexpr double MAX_SHINE = 1e9, MAX_IOR = 1e6, MAX_COLOUR = 1000, MAX_TIME = 1e6,
                 MAX_COORDINATE = 1e6;

// The first words of a comment.
struct Words {
  std::string_view name, second, third;
};
Words split(std::string_view comment) {
  const auto take = [&] {
    constexpr std::string_view BLANKS = " \t\r\v\f";
    const auto end = std::min(comment.find_first_of(BLANKS), comment.size());
    const std::string_view word = comment.substr(0, end);
    comment.remove_prefix(std::min(comment.find_first_not_of(BLANKS, end), comment.size()));
    return word;
  };
  const auto name = take(), second = take();
  return {name, second, take()};
}

// How a comment that is a statement goes on after its name. Others are prose.
bool always(const Words&) { return true; }
bool has_number(const Words& words) { return parse_number(words.second).has_value(); }
bool has_shape(const Words& words) {
  return (words.second == "rect" || words.second == "sphere") && parse_number(words.third);
}
bool has_file(const Words& words) {
  return std::ranges::any_of(std::array{".path", ".csv", ".txt"}, [&](const char* ending) {
    return words.second.ends_with(ending) && (words.third.empty() || words.third.starts_with('#'));
  });
}

bool has_picture(const Words& words) {
  const bool is_mapping =
      words.third == "planar" || words.third == "spherical" || words.third == "mesh";
  return words.second.ends_with(".png") || words.second.ends_with(".PNG") ||
         (is_mapping && words.second.find('.') != words.second.npos);
}

class Reader {
 public:
  Reader(std::string_view text, const std::string& name, NffTarget& target)
      : tokens_(text, name, target.is_room() ? &is_statement<true> : &is_statement<false>),
        target_(target) {}

  void read() {
    while (!tokens_.peek().empty()) read_statement();
    require_polygon({});
    if (view_line_ == 0) tokens_.fail_next("a view ('v')");
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
    if (tokens_.take_if("#")) return read_comment();
    require_polygon(name);
    const Read read = tokens_.take_choice(
        STATEMENTS, target_.is_room() ? "a statement: v, b, l, f, # emit, p or pp"
                                      : "a statement: v, b, l, f, s, p, pp or c");
    target_.line = tokens_.line();
    if (name == "s" || name == "p" || name == "pp" || name == "c") require_surface(name);
    read(*this);
  }

  // A statement that other readers of NFF take for a comment.
  struct Comment {
    std::string_view name;
    bool is_of_rooms;
    bool (*goes_on)(const Words&);
    void (*read)(Reader&);
  };
  static std::span<const Comment> comments() {
    static constexpr Comment COMMENTS[] = {
        {"emit", true, &always, [](Reader& r) { r.read_emission(); }},
        {"lens", false, &has_number, [](Reader& r) { r.read_lens(); }},
        {"shutter", false, &has_number, [](Reader& r) { r.read_shutter(); }},
        {"move", false, &has_number, [](Reader& r) { r.read_move(); }},
        {"path", false, &has_file, [](Reader& r) { r.read_path(); }},
        {"camera", false, &has_file, [](Reader& r) { r.read_camera(); }},
        {"light", false, &has_shape, [](Reader& r) { r.read_area_light(); }},
        {"gloss", false, &has_number, [](Reader& r) { r.read_spread("# gloss", &Surface::gloss); }},
        {"translucent", false, &has_number,
         [](Reader& r) { r.read_spread("# translucent", &Surface::translucency); }},
        {"texture", false, &has_picture, [](Reader& r) { r.read_texture(); }},
        {"uv", false, &has_number, [](Reader& r) { r.read_coordinates(); }}};
    return COMMENTS;
  }

  template <bool IS_ROOM>
  static bool is_statement(std::string_view comment) {
    const Words words = split(comment);
    return std::ranges::any_of(comments(), [&](const Comment& known) {
      return known.name == words.name && known.is_of_rooms == IS_ROOM && known.goes_on(words);
    });
  }

  void read_comment() {
    target_.line = tokens_.line();
    const auto known = std::ranges::find(comments(), tokens_.take(), &Comment::name);
    require_polygon(known->name);
    tokens_.within_line([&] { known->read(*this); });
  }

  // Of a statement that a file has once.
  void require_first(std::string_view statement, int& line) {
    if (line != 0)
      tokens_.fail(target_.line, fmt::format("found a second '{}', expected one, that of line {}",
                                             statement, line));
    line = target_.line;
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
    require_first("v", view_line_);
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
    Light light;
    light.at = tokens_.take_vec("the light's position");
    end_light(light);
  }

  void read_area_light() {
    Light light;
    const bool is_sphere = tokens_.take() == "sphere";
    light.shape = is_sphere ? LightShape::sphere : LightShape::rectangle;
    light.at = tokens_.take_vec("the light's middle");
    if (is_sphere) {
      light.radius = tokens_.take_number("the light's radius", 0, MAX_NUMBER);
      tell([&] { require(light.radius > 0, "a light of radius 0", "a radius > 0"); });
    } else {
      light.u = tokens_.take_vec("the light's first half edge");
      light.v = tokens_.take_vec("the light's second half edge");
      tell([&] {
        require(length(cross(light.u, light.v)) > 1e-9 * length(light.u) * length(light.v),
                "a light without area", "half edges that are not parallel, and not of length 0");
      });
    }
    end_light(light);
  }

  void end_light(const Light& light) {
    std::optional<Rgb> colour;
    if (tokens_.continues()) colour = take_colour("the light's colour");
    tell([&] { target_.add_light(light, colour); });
  }

  void read_lens() {
    require_first("# lens", lens_line_);
    Lens lens;
    lens.aperture = tokens_.take_number("the lens's aperture", 0, MAX_NUMBER);
    lens.focus = tokens_.take_number("the distance in focus", MIN_FOCUS, MAX_NUMBER);
    tell([&] { target_.set_lens(lens); });
  }

  void read_shutter() {
    require_first("# shutter", shutter_line_);
    Shutter shutter;
    shutter.open = tokens_.take_number("the time in frames when it opens", 0, MAX_TIME);
    shutter.close =
        tokens_.take_number("the time in frames when it closes", shutter.open, MAX_TIME);
    tell([&] { target_.set_shutter(shutter); });
  }

  void read_move() {
    const Vec velocity = tokens_.take_vec("a velocity in scene units a frame");
    tell([&] { target_.set_motion({velocity, {}}); });
  }

  // The name of a file beside this one.
  std::string take_file() {
    const auto folder = std::filesystem::path(tokens_.name()).parent_path();
    const auto file = (folder / tokens_.take_word("a file")).string();
    target_.add_file(file);
    return file;
  }

  Path take_path(bool has_target) {
    Path path;
    const auto file = take_file();
    tell([&] { path = load_path(file, has_target); });
    return path;
  }

  void read_path() {
    Path path = take_path(false);
    tell([&] { target_.set_motion({{}, std::move(path)}); });
  }

  void read_camera() {
    require_first("# camera", camera_line_);
    Path path = take_path(true);
    tell([&] { target_.set_camera(std::move(path)); });
  }

  void read_spread(std::string_view statement, double Surface::*radius) {
    require_surface(statement);
    surface_.*radius = tokens_.take_number("the radius of a disc at distance 1", 0, 1);
    tell([&] { target_.change_surface(surface_); });
  }

  void read_texture() {
    require_surface("# texture");
    const auto file = take_file();
    const Mapping mapping = take_mapping();
    tell([&] {
      surface_.texture = target_.add_texture(file, mapping);
      target_.change_surface(surface_);
    });
  }

  Mapping take_mapping() {
    constexpr std::pair<std::string_view, Mapping (*)(Reader&)> MAPPINGS[] = {
        {"planar", [](Reader& r) { return r.take_planar(); }},
        {"spherical", [](Reader& r) { return r.take_spherical(); }},
        {"mesh", [](Reader&) { return make_mesh_mapping(); }}};
    return tokens_.take_choice(MAPPINGS, "a mapping: planar, spherical or mesh")(*this);
  }

  Mapping take_planar() {
    const Vec origin = tokens_.take_vec("the texture's lower left corner");
    const Vec u = tokens_.take_vec("the texture's lower edge");
    const Vec v = tokens_.take_vec("the texture's left edge");
    Mapping mapping;
    tell([&] { mapping = make_planar(origin, u, v); });
    return mapping;
  }

  Mapping take_spherical() {
    const Vec middle = tokens_.take_vec("the texture's middle");
    Vec axis{0, 0, 1};
    if (tokens_.take_if("axis")) axis = tokens_.take_vec("the texture's axis");
    Mapping mapping;
    tell([&] { mapping = make_spherical(middle, axis); });
    return mapping;
  }

  void read_coordinates() {
    while (tokens_.continues()) {
      const auto take = [&] {
        return tokens_.take_number("a texture coordinate", -MAX_COORDINATE, MAX_COORDINATE);
      };
      const double u = take();
      coordinates_.push_back({u, take()});
    }
  }

  // After '# uv'.
  void require_polygon(std::string_view statement) {
    if (coordinates_.empty() || statement == "p" || statement == "pp" || statement == "uv") return;
    const auto found = statement.empty() ? "the end of the file" : base::quote(statement);
    tokens_.fail(tokens_.line(),
                 fmt::format("found {} after '# uv', expected its polygon: p or pp", found));
  }

  void read_surface() {
    Surface& s = surface_ = {};
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
    target_.set_coordinates(std::exchange(coordinates_, {}));
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
  int view_line_ = 0, lens_line_ = 0, shutter_line_ = 0, camera_line_ = 0;
  bool has_surface_ = false;
  Surface surface_;                  // set last
  std::vector<Corner> coordinates_;  // of the polygon to come
};

}  // namespace

void read_nff(std::string_view text, const std::string& name, NffTarget& target) {
  Reader(text, name, target).read();
}

Scene parse_nff(std::string_view text, const std::string& name, int frame) {
  SceneTarget target(name);
  read_nff(text, name, target);
  return target.make_scene(frame);
}

std::vector<std::string> find_files(const std::string& nff) {
  SceneTarget target(nff);
  read_nff(base::read_text(nff), nff, target);
  return target.files();
}

Scene load_scene(const std::string& source, int frame) {
  if (source.ends_with(".nff")) return parse_nff(base::read_text(source), source, frame);
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
