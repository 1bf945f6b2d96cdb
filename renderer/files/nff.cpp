#include "renderer/files/nff.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <functional>

#include "base/text.hpp"
#include "renderer/files/text/statements.hpp"
#include "renderer/files/text/tokens.hpp"
#include "renderer/scene/require.hpp"

namespace renderer {

namespace {

constexpr int MAX_VERTICES = 1 << 24;
constexpr double MAX_TIME = 1e6;

// Predicates that decide whether a comment is a statement. The words after the statement's name
// must have the form of that statement; otherwise the comment is prose.
bool always(const Words&) { return true; }
bool has_file(const Words& words) {
  const auto name = base::to_lower(words.second);
  return std::ranges::any_of(std::array{".path", ".csv", ".txt"}, [&](const char* ending) {
    return name.ends_with(ending) && (words.third.empty() || words.third.starts_with('#'));
  });
}

bool has_picture(const Words& words) {
  const bool is_mapping =
      words.third == "planar" || words.third == "spherical" || words.third == "mesh";
  const auto name = base::to_lower(words.second);
  // Endings of pictures. Only PNG is supported; the loader of textures refuses the other formats.
  constexpr const char* ENDINGS[] = {".png", ".jpg", ".jpeg", ".gif", ".bmp", ".tif", ".webp"};
  return std::ranges::any_of(ENDINGS, [&](const char* end) { return name.ends_with(end); }) ||
         (is_mapping && words.second.find('.') != words.second.npos);
}

class Reader {
  using Knows = NffTarget::Knows;

 public:
  Reader(std::string_view text, const std::string& name, NffTarget& target)
      : tokens_(text, name, statements_of(target.knows())), target_(target) {}

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
        {"b",
         [](Reader& r) { r.target_.set_background(take_colour(r.tokens_, "the background")); }},
        {"l", [](Reader& r) { r.read_light(false); }},
        {"f", [](Reader& r) { r.read_surface(); }},
        {"s", [](Reader& r) { r.read_sphere(); }},
        {"p", [](Reader& r) { r.read_corners(false); }},
        {"pp", [](Reader& r) { r.read_corners(true); }},
        {"c", [](Reader& r) { r.read_cone(); }}};
    const std::string_view name = tokens_.peek();
    if (tokens_.take_if("#")) return read_comment();
    require_polygon(name);
    const Read read = tokens_.take_choice(
        STATEMENTS, target_.knows() == Knows::rooms ? "a statement: v, b, l, f, # emit, p or pp"
                                                    : "a statement: v, b, l, f, s, p, pp or c");
    target_.line = tokens_.line();
    if (name == "s" || name == "p" || name == "pp" || name == "c") require_surface(name);
    read(*this);
  }

  // A statement inside a comment, which other NFF readers ignore.
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
        {"light", false, &has_light_shape, [](Reader& r) { r.read_light(true); }},
        {"gloss", false, &has_number, [](Reader& r) { r.read_spread("# gloss", &Surface::gloss); }},
        {"translucent", false, &has_number,
         [](Reader& r) { r.read_spread("# translucent", &Surface::translucency); }},
        {"texture", false, &has_picture, [](Reader& r) { r.read_texture(); }},
        {"uv", false, &has_number, [](Reader& r) { r.read_coordinates(); }}};
    return COMMENTS;
  }

  template <Knows KNOWS>
  static bool is_statement(std::string_view comment) {
    const Words words = first_words(comment);
    return std::ranges::any_of(comments(), [&](const Comment& known) {
      const auto others = known.is_of_rooms ? Knows::scenes : Knows::rooms;
      return known.name == base::to_lower(words.name) && KNOWS != others && known.goes_on(words) &&
             (KNOWS != Knows::both || !known.is_of_rooms || has_number(words));
    });
  }
  static Tokens::IsStatement statements_of(Knows knows) {
    return knows == Knows::scenes  ? &is_statement<Knows::scenes>
           : knows == Knows::rooms ? &is_statement<Knows::rooms>
                                   : &is_statement<Knows::both>;
  }

  void read_comment() {
    target_.line = tokens_.line();
    const auto known =
        std::ranges::find(comments(), base::to_lower(tokens_.take()), &Comment::name);
    require_polygon(known->name);
    tokens_.within_line([&] { known->read(*this); });
  }

  // Throws BadInput if a statement that may appear only once appears a second time.
  void require_first(std::string_view statement, int& line) {
    if (line != 0)
      tokens_.fail(target_.line, fmt::format("found a second '{}', expected only that of line {}",
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

  void read_view() {
    require_first("v", view_line_);
    const View view = take_view(tokens_);
    tell([&] { target_.set_view(view); });
  }

  void read_light(bool has_area) {
    const auto [light, colour] = has_area ? take_area_light(tokens_) : take_light(tokens_);
    tell([&] { target_.add_light(light, colour); });
  }

  void read_lens() {
    require_first("# lens", lens_line_);
    Lens lens;
    lens.aperture = tokens_.take_number("the lens's aperture", 0, MAX_NUMBER);
    lens.focus = tokens_.take_number("the lens's focal distance", MIN_FOCUS, MAX_NUMBER);
    tell([&] { target_.set_lens(lens); });
  }

  void read_shutter() {
    require_first("# shutter", shutter_line_);
    Shutter shutter;
    shutter.open = tokens_.take_number("the opening time in frames", 0, MAX_TIME);
    shutter.close = tokens_.take_number("the closing time in frames", shutter.open, MAX_TIME);
    tell([&] { target_.set_shutter(shutter); });
  }

  void read_move() {
    const Vec velocity = tokens_.take_vec("a velocity in scene units per frame");
    tell([&] { target_.set_motion({velocity, {}}); });
  }

  // Takes a file name and makes its path relative to the folder of the NFF file.
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
    const Vec middle = tokens_.take_vec("the texture's centre");
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

  // Throws BadInput if the statement after '# uv' is not a polygon.
  void require_polygon(std::string_view statement) {
    if (coordinates_.empty() || statement == "p" || statement == "pp" || statement == "uv") return;
    const auto found = statement.empty() ? "the end of the file" : base::quote(statement);
    tokens_.fail(tokens_.line(),
                 fmt::format("found {} after '# uv', expected its polygon: p or pp", found));
  }

  void read_surface() {
    Surface& s = surface_ = {};
    s.colour = take_colour(tokens_, "the surface's colour");
    s.kd = tokens_.take_number("Kd", 0, 1);
    s.ks = tokens_.take_number("Ks", 0, 1);
    s.shine = tokens_.take_number("Shine", 0, MAX_SHINE);
    s.t = tokens_.take_number("T", 0, 1);
    const double ior = tokens_.take_number("the index of refraction", 0, MAX_IOR);
    if (ior > 0)
      s.ior = ior;
    else if (s.t > 0)  // opaque surfaces may state an index of refraction of 0
      tokens_.fail(tokens_.line(),
                   "found an index of refraction of 0, expected more than 0 because T > 0");
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
  Surface surface_;  // surface of the latest 'f' statement and the comments after it
  std::vector<Corner> coordinates_;  // texture coordinates of the next polygon
};

}  // namespace

void read_nff(std::string_view text, const std::string& name, NffTarget& target) {
  Reader(text, name, target).read();
}

}  // namespace renderer
