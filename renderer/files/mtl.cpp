#include "renderer/files/mtl.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/text.hpp"
#include "renderer/files/beside.hpp"
#include "renderer/files/text/statements.hpp"

namespace renderer {

namespace {

constexpr int FIRST_TRANSPARENT_ILLUM = 4;

bool is_surface(std::string_view comment) {
  const Words words = first_words(comment);
  return words.name == "surface" && has_number(words);
}

bool is_png(const std::string& path) {
  constexpr std::string_view SIGNATURE = "\x89PNG\r\n\x1a\n";
  std::string head(SIGNATURE.size(), '\0');
  if (!std::filesystem::is_regular_file(path)) return false;
  std::ifstream(path, std::ios::binary).read(head.data(), std::ssize(head));
  return head == SIGNATURE;
}

// The words of a statement that names a picture: options, then a file name that may contain blanks.
class MapWords {
 public:
  explicit MapWords(std::string_view text) : rest_(text) {}

  std::string_view peek() const { return rest_.substr(0, rest_.find_first_of(" \t")); }
  std::string_view take() {
    const auto word = peek();
    rest_ = base::trim(rest_.substr(word.size()));
    return word;
  }
  std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_;  // remaining text, without blanks at its ends
};

class MtlReader {
 public:
  MtlReader(std::string_view text, const std::string& path, LeftOut& left_out)
      : tokens_(text, path, &is_surface, Tokens::Lines::joined), left_out_(left_out) {}

  std::vector<MtlEntry> read() {
    while (tokens_.begin_line()) try {
        read_statement();
      } catch (const base::BadInput& bad) {
        left_out_.add("unreadable values of materials", bad.what());
        tokens_.skip_line();
      }
    std::vector<MtlEntry> entries;
    for (Draft& draft : drafts_) entries.push_back(finish(draft));
    return entries;
  }

 private:
  struct Draft : MtlEntry {
    std::optional<double> opacity{}, transmission{};  // from the statements d and Tr
    std::optional<Rgb> filter{};                      // from the statement Tf
    bool has_diffuse = false;
  };

  using Read = void (*)(MtlReader&, Draft&);

  static Read find_statement(const std::string& name) {
    static constexpr std::pair<std::string_view, Read> STATEMENTS[] = {
        {"kd", [](auto& r, auto& d) { r.read_diffuse(d); }},
        {"ks", [](auto& r, auto& d) { d.material.specular = r.take_colour("Ks", 1); }},
        {"ke", [](auto& r, auto& d) { d.material.emission = r.take_colour("Ke", MAX_NUMBER); }},
        {"tf", [](auto& r, auto& d) { d.filter = r.take_colour("Tf", 1); }},
        {"ns", [](auto& r, auto& d) { d.material.shine = r.take("Ns", MAX_SHINE); }},
        {"ni", [](auto& r, auto& d) { r.read_ior(d.material); }},
        {"d", [](auto& r, auto& d) { r.read_opacity(d); }},
        {"tr", [](auto& r, auto& d) { d.transmission = r.take("Tr", 1); }},
        {"illum", [](auto& r, auto& d) { d.material.illum = r.take_illum(); }},
        {"map_kd", [](auto& r, auto& d) { r.read_picture(d); }},
        {"#", [](auto& r, auto& d) { r.read_surface(d.material); }}};
    const auto* known =
        std::ranges::find(STATEMENTS, name, &std::pair<std::string_view, Read>::first);
    if (known != std::end(STATEMENTS)) return known->second;
    constexpr std::string_view WITHOUT_EFFECT[] = {"ka", "sharpness", "map_aat", "pr",    "pm",
                                                   "ps", "pc",        "pcr",     "aniso", "anisor"};
    if (std::ranges::find(WITHOUT_EFFECT, name) != std::end(WITHOUT_EFFECT)) return &skip;
    constexpr std::string_view PICTURES[] = {"bump", "disp", "decal", "refl", "norm"};
    if (name.starts_with("map_") || std::ranges::find(PICTURES, name) != std::end(PICTURES))
      return &leave_picture_out;
    return nullptr;
  }

  static void skip(MtlReader& r, Draft&) { r.tokens_.take_rest(); }
  static void leave_picture_out(MtlReader& r, Draft&) {
    r.left_out_.add("pictures for properties other than colour");
    r.tokens_.take_rest();
  }

  void read_statement() {
    const auto name = base::to_lower(tokens_.take());
    if (name == "newmtl") {
      drafts_.push_back({{.line = tokens_.line()}});
      drafts_.back().material.name = tokens_.take_rest();
      return;
    }
    const Read read = find_statement(name);
    if (!read) {
      left_out_.add("unknown statements of materials",
                    fmt::format("{}:{}: found {}, expected a statement of MTL", tokens_.name(),
                                tokens_.line(), base::quote(name)));
      tokens_.take_rest();
      return;
    }
    if (drafts_.empty())
      tokens_.fail(tokens_.line(), fmt::format("found '{}', expected 'newmtl' before it", name));
    read(*this, drafts_.back());
    tokens_.end_line();
  }

  double take(std::string_view what, double most) { return tokens_.take_number(what, 0, most); }

  // Takes a colour of three numbers. A single number stands for all three.
  Rgb take_colour(std::string_view what, double most) {
    const double r = take(what, most);
    if (!tokens_.continues()) return {r, r, r};
    const double g = take(what, most);
    return {r, g, take(what, most)};
  }

  void read_diffuse(Draft& draft) {
    draft.material.set_diffuse(take_colour("Kd", MAX_COLOUR));
    draft.has_diffuse = true;
  }

  // Reads an index of refraction. For opaque materials, files may state 0, which becomes 1.
  void read_ior(MtlMaterial& material) {
    const double ior = take("Ni", MAX_IOR);
    material.ior = ior > 0 ? ior : 1;
  }

  void read_opacity(Draft& draft) {
    if (tokens_.take_if("-halo")) left_out_.add("halo options of materials");
    draft.opacity = take("d", 1);
  }

  int take_illum() {
    constexpr int MAX_ILLUM = 10;
    return tokens_.take_count("illum", 0, MAX_ILLUM);
  }

  void read_surface(MtlMaterial& material) {
    tokens_.take();
    const Rgb colour = renderer::take_colour(tokens_, "the surface's colour");
    const double kd = take("KD", 1);
    if (kd * colour == material.diffuse) material.set_diffuse(colour, kd);
  }

  void read_picture(Draft& draft) {
    const int line = tokens_.line();
    const auto rest = tokens_.take_rest();
    MapWords words(rest);
    while (words.peek().starts_with('-') && take_option(words, draft.map)) {
    }
    const auto file = find_beside(tokens_.name(), words.rest());
    draft.material.picture = file && is_png(*file) ? *file : "";
    if (draft.material.picture.empty())
      left_out_.add("pictures",
                    fmt::format("{}:{}: found {}, expected {}", tokens_.name(), line,
                                base::quote(cut_comment(words.rest())),
                                file ? "a PNG picture" : "the name of an existing file"));
  }

  // Takes an option and its values. Returns false if the next word is not an option.
  bool take_option(MapWords& words, PictureMap& map) {
    struct Option {
      std::string_view name;
      int values;
      bool has_effect;
    };
    constexpr Option OPTIONS[] = {
        {"-blendu", 1, false}, {"-blendv", 1, false}, {"-texres", 1, false}, {"-boost", 1, false},
        {"-bm", 1, false},     {"-clamp", 1, true},   {"-cc", 1, true},      {"-imfchan", 1, true},
        {"-type", 1, true},    {"-mm", 2, true}};
    const auto name = words.peek();
    if (name == "-o" || name == "-s" || name == "-t") {
      words.take();
      const double otherwise = name == "-s" ? 1 : 0;
      const auto [u, v] = take_pair(words, otherwise);
      if (name == "-o") map.u_offset = u, map.v_offset = v;
      if (name == "-s") map.u_scale = u, map.v_scale = v;
      if (name == "-t" && (u != 0 || v != 0))
        left_out_.add("options of pictures without an equivalent");
      return true;
    }
    const auto* known = std::ranges::find(OPTIONS, name, &Option::name);
    if (known == std::end(OPTIONS)) return false;
    words.take();
    bool is_off = true;
    for (int i = 0; i < known->values; ++i) is_off = words.take() == "off" && is_off;
    if (known->has_effect && !is_off) left_out_.add("options of pictures without an equivalent");
    return true;
  }

  // Takes one to three numbers and returns the first two. For a missing second number, returns
  // `otherwise`.
  static std::pair<double, double> take_pair(MapWords& words, double otherwise) {
    double values[] = {otherwise, otherwise, otherwise};
    for (double& value : values) {
      const auto number = parse_number(words.peek());
      if (!number || std::abs(*number) > MAX_COORDINATE) break;
      value = *number;
      words.take();
    }
    return {values[0], values[1]};
  }

  MtlEntry finish(Draft& draft) {
    auto& material = draft.material;
    set_transparency(draft);
    const bool reflects = material.illum >= ILLUM_REFLECTS && material.specular != Rgb{};
    if (!draft.has_diffuse && !material.picture.empty()) {
      material.set_diffuse({1, 1, 1});
    } else if (!draft.has_diffuse && !reflects && material.emission == Rgb{} &&
               material.transparency == 0) {
      material.set_diffuse(LIGHT_GREY);
      remark(draft, "materials in light grey", "no Kd", "one");
    }
    if (material.transparency > 0 && draft.filter.value_or(Rgb{1, 1, 1}) != Rgb{1, 1, 1})
      left_out_.add("colours of transmitted light");
    return draft;
  }

  void set_transparency(Draft& draft) {
    constexpr double ROUNDED = 1e-6;
    const auto& [d, tr] = std::pair(draft.opacity, draft.transmission);
    if (!d && !tr) return;
    if (!d && *tr == 1 && draft.material.illum < FIRST_TRANSPARENT_ILLUM)
      return remark(draft, "materials made opaque", "Tr 1",
                    "'d', or illum 4 or more, if the material is meant to be invisible");
    const bool is_tr_meant = tr && (!d || std::abs(*d + *tr - 1) <= ROUNDED);
    draft.material.transparency = is_tr_meant ? *tr : 1 - *d;
  }

  void remark(const Draft& draft, const char* kind, std::string_view found,
              std::string_view expected) {
    left_out_.replace(kind, fmt::format("{}:{}: found {}, expected {}", tokens_.name(), draft.line,
                                        found, expected));
  }

  Tokens tokens_;
  LeftOut& left_out_;
  std::vector<Draft> drafts_;
};

}  // namespace

std::vector<MtlEntry> read_mtl(std::string_view text, const std::string& path, LeftOut& left_out) {
  return MtlReader(text, path, left_out).read();
}

}  // namespace renderer
