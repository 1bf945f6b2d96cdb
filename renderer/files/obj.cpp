#include "renderer/files/obj.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>

#include "base/text.hpp"
#include "base/whole_file.hpp"

namespace renderer {

namespace {

bool is_surface(std::string_view comment) {
  const Words words = first_words(comment);
  return words.name == "surface" && has_number(words);
}

bool is_statement(std::string_view comment) {
  const Words words = first_words(comment);
  return (words.name == "v" && words.second == "from" && parse_number(words.third)) ||
         ((words.name == "b" || words.name == "l") && has_number(words)) ||
         (words.name == "light" && has_light_shape(words));
}

// Takes the rest of the line, and reduces blanks between words to one.
std::string take_line(Tokens& tokens, std::string_view what) {
  std::string text(tokens.take_word(what));
  while (tokens.continues()) text += fmt::format(" {}", tokens.take());
  return text;
}

std::string find_beside(const std::string& name, std::string_view file) {
  return (std::filesystem::path(name).parent_path() / file).string();
}

class MtlReader {
 public:
  MtlReader(std::string_view text, const std::string& path) : tokens_(text, path, &is_surface) {}

  struct Draft {
    MtlMaterial material;
    int line;
    std::optional<double> opacity, transparency;  // statements d and Tr
  };

  std::vector<Draft> read() {
    while (tokens_.begin_line()) read_statement();
    for (auto& [material, line, d, tr] : drafts_)
      if (d || tr) {
        constexpr double ROUNDED = 1e-6;
        const bool is_tr_meant = tr && (!d || std::abs(*d + *tr - 1) <= ROUNDED);
        material.transparency = is_tr_meant ? *tr : 1 - *d;
      }
    return std::move(drafts_);
  }

  const Tokens& tokens() const { return tokens_; }

 private:
  void read_statement() {
    using Read = void (*)(MtlReader&, Draft&);
    static constexpr std::pair<std::string_view, Read> STATEMENTS[] = {
        {"Kd", [](auto& r, auto& d) { d.material.set_diffuse(r.tokens_.take_rgb("Kd")); }},
        {"Ks", [](auto& r, auto& d) { d.material.specular = r.tokens_.take_rgb("Ks"); }},
        {"Ke", [](auto& r, auto& d) { d.material.emission = r.tokens_.take_rgb("Ke"); }},
        {"Ns", [](auto& r, auto& d) { d.material.shine = r.take("Ns", MAX_SHINE); }},
        {"Ni", [](auto& r, auto& d) { d.material.ior = r.take("Ni", MAX_IOR); }},
        {"d", [](auto& r, auto& d) { d.opacity = r.take("d", 1); }},
        {"Tr", [](auto& r, auto& d) { d.transparency = r.take("Tr", 1); }},
        {"illum", [](auto& r, auto& d) { d.material.illum = r.take_illum(); }},
        {"map_Kd",
         [](auto& r, auto& d) {
           d.material.picture = find_beside(r.tokens_.name(), take_line(r.tokens_, "a picture"));
         }},
        {"#", [](auto& r, auto& d) { r.read_surface(d.material); }}};
    const std::string_view name = tokens_.take();
    if (name == "newmtl") {
      drafts_.push_back({{}, tokens_.line(), {}, {}});
      drafts_.back().material.name = tokens_.take_word("a name");
      return tokens_.end_line();
    }
    const auto* known =
        std::ranges::find(STATEMENTS, name, [](const auto& statement) { return statement.first; });
    if (known == std::end(STATEMENTS)) return tokens_.skip_line();
    if (drafts_.empty())
      tokens_.fail(tokens_.line(), fmt::format("found '{}', expected 'newmtl' before it", name));
    known->second(*this, drafts_.back());
    tokens_.end_line();
  }

  double take(std::string_view what, double most) { return tokens_.take_number(what, 0, most); }

  int take_illum() {
    constexpr int MAX_ILLUM = 10;
    return tokens_.take_count("illum", 0, MAX_ILLUM);
  }

  void read_surface(MtlMaterial& material) {
    tokens_.take();
    const Rgb colour = take_colour(tokens_, "the surface's colour");
    const double kd = take("KD", 1);
    if (kd * colour == material.diffuse) material.set_diffuse(colour, kd);
  }

  Tokens tokens_;
  std::vector<Draft> drafts_;
};

class ObjReader {
 public:
  ObjReader(std::string_view text, const std::string& path, ObjTarget& target)
      : tokens_(text, path, &is_statement), target_(target) {}

  void read() {
    while (tokens_.begin_line()) read_statement();
  }

 private:
  void read_statement() {
    using Read = void (*)(ObjReader&);
    constexpr auto skip = [](ObjReader& r) { r.tokens_.skip_line(); };
    constexpr std::pair<std::string_view, Read> STATEMENTS[] = {
        {"v", [](ObjReader& r) { r.read_point(); }},
        {"vt", [](ObjReader& r) { r.read_coordinates(); }},
        {"vn", [](ObjReader& r) { r.read_normal(); }},
        {"f", [](ObjReader& r) { r.read_face(); }},
        {"usemtl", [](ObjReader& r) { r.use_material(); }},
        {"mtllib", [](ObjReader& r) { r.read_libraries(); }},
        {"#", [](ObjReader& r) { r.read_comment(); }},
        {"p", [](ObjReader& r) { r.leave_out("points"); }},
        {"l", [](ObjReader& r) { r.leave_out("lines"); }},
        {"g", skip},
        {"o", skip},
        {"s", skip}};
    const Read read =
        tokens_.take_choice(STATEMENTS, "a statement: v, vt, vn, f, g, o, s, usemtl or mtllib");
    target_.line = tokens_.line();
    read(*this);
  }

  template <class Action>
  void tell(const Action& action) {
    tokens_.at_line(target_.line, action);
  }

  void leave_out(const char* kind) {
    target_.leave_out(kind);
    tokens_.skip_line();
  }

  // Reads a vertex. A weight (one number) or a colour may follow its coordinates.
  void read_point() {
    points_.push_back(tokens_.take_vec("a vertex"));
    if (tokens_.continues()) tokens_.take();
    if (tokens_.continues()) target_.leave_out("colours of corners");
    tokens_.skip_line();
  }

  void read_normal() {
    normals_.push_back(tokens_.take_vec("a normal"));
    tokens_.end_line();
  }

  void read_coordinates() {
    const auto take = [&] {
      return tokens_.take_number("a texture coordinate", -MAX_COORDINATE, MAX_COORDINATE);
    };
    const double u = take();
    coordinates_.push_back({u, tokens_.continues() ? take() : 0});
    tokens_.skip_line();  // skip a third coordinate
  }

  void use_material() {
    const auto known = std::ranges::find(names_, tokens_.peek());
    if (known == names_.end())
      tokens_.fail_next(
          fmt::format("a material of the files above: {}",
                      names_.empty() ? "none yet" : fmt::format("{}", fmt::join(names_, ", "))));
    tokens_.skip_line();
    tell([&] { target_.use_material(static_cast<std::size_t>(known - names_.begin())); });
  }

  void read_libraries() {
    do {
      const auto path = find_beside(tokens_.name(), tokens_.take_word("a file"));
      if (std::ranges::find(libraries_, path) != libraries_.end()) continue;
      libraries_.push_back(path);
      tell([&] { target_.add_library(path); });
      std::string text;
      tell([&] { text = base::read_text(path); });
      read_library(text, path);
    } while (!tokens_.peek().empty());
  }

  void read_library(const std::string& text, const std::string& path) {
    MtlReader reader(text, path);
    for (const auto& draft : reader.read()) {
      const auto& name = draft.material.name;
      reader.tokens().at_line(draft.line, [&] {
        target_.add_material(draft.material);
        require(std::ranges::find(names_, name) == names_.end(),
                fmt::format("a second material {}", base::quote(name)), "another name");
      });
      names_.push_back(name);
    }
  }

  void read_comment() {
    const std::string_view name = tokens_.take();
    if (name == "v") {
      const View view = take_view(tokens_);
      tell([&] {
        require(!std::exchange(has_view_, true), "a second '# v'", "one");
        target_.set_view(view);
      });
    } else if (name == "b") {
      const Rgb colour = take_colour(tokens_, "the background");
      tell([&] { target_.set_background(colour); });
    } else {
      const auto [light, colour] = name == "l" ? take_light(tokens_) : take_area_light(tokens_);
      tell([&] { target_.add_light(light, colour); });
    }
    tokens_.end_line();
  }

  // Reads a face, whose corners have the form v, v/vt, v//vn or v/vt/vn.
  void read_face() {
    std::vector<Vec> corners, normals;
    std::vector<Corner> coordinates;
    while (!tokens_.peek().empty()) {
      const std::string_view word = tokens_.peek();
      const auto slash = std::min(word.find('/'), word.size());
      const auto second = std::min(word.find('/', slash + 1), word.size());
      corners.push_back(find(points_, word.substr(0, slash), "vertex (v)"));
      if (second > slash + 1)
        coordinates.push_back(
            find(coordinates_, word.substr(slash + 1, second - slash - 1), "coordinate (vt)"));
      if (second < word.size())
        normals.push_back(find(normals_, word.substr(second + 1), "normal (vn)"));
      tokens_.take();
    }
    tell([&] {
      const auto count = corners.size();
      const auto require_all = [&](std::size_t found, const char* what) {
        require(found == 0 || found == count, fmt::format("{} {}", found, what),
                fmt::format("one for each of the {} corners", count));
      };
      require(count >= 3, fmt::format("{} corners", count), "3 or more");
      require_all(normals.size(), "normals");
      require_all(coordinates.size(), "texture coordinates");
      target_.add_face(std::move(corners), std::move(normals), std::move(coordinates));
    });
  }

  // The item that a corner refers to: counted from 1, or backwards from -1.
  template <class Item>
  const Item& find(const std::vector<Item>& list, std::string_view text, const char* what) {
    const auto count = static_cast<long long>(list.size());
    const long long n = base::parse_number<long long>(text).value_or(0);
    if (n == 0 || n > count || n < -count)
      tokens_.fail_next(
          fmt::format("the number of a {} in each corner, of the {} so far, 1 the first and "
                      "-1 the last",
                      what, count));
    return list[static_cast<std::size_t>(n > 0 ? n - 1 : count + n)];
  }

  Tokens tokens_;
  ObjTarget& target_;
  std::vector<Vec> points_, normals_;
  std::vector<Corner> coordinates_;
  std::vector<std::string> names_, libraries_;  // names of materials, and paths of the MTL files
  bool has_view_ = false;
};

}  // namespace

void read_obj(std::string_view text, const std::string& name, ObjTarget& target) {
  ObjReader(text, name, target).read();
}

View look_from_outside(const Bounds& bounds) {
  View view;
  const Vec across = bounds.hi - bounds.lo;
  if (std::hypot(across.x, across.z) < 1e-3 * across.y) view.up = {0, 0, 1};
  const double sine = 0.38268343236508977;  // sine of half the view's 45 degrees
  view.at = 0.5 * (bounds.lo + bounds.hi);
  view.from = view.at + (0.5 / sine) * across;
  return view;
}

}  // namespace renderer
