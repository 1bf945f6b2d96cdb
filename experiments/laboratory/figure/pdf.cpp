#include "experiments/laboratory/figure/pdf.hpp"

#include <cairo/cairo-pdf.h>
#include <fmt/format.h>

#include <boost/algorithm/string/replace.hpp>
#include <map>
#include <memory>
#include <numbers>
#include <stdexcept>

#include "base/errors.hpp"
#include "base/text.hpp"
#include "base/whole_file.hpp"
#include "experiments/laboratory/figure/svg_style.hpp"

namespace laboratory {
namespace {

using topologies::XmlElement;

constexpr double FULL_TURN = 2 * std::numbers::pi;

// Splits path data into commands with their numbers: "M1 2h3" into M(1, 2) and h(3).
struct PathCommand {
  char name;
  std::vector<double> numbers;
};

std::vector<PathCommand> split_path(std::string_view data) {
  std::vector<PathCommand> commands;
  while (!data.empty()) {
    const auto is_command = [](char c) {
      return std::isalpha(static_cast<unsigned char>(c)) && c != 'e';
    };
    std::size_t end = 1;
    while (end < data.size() && !is_command(data[end])) ++end;
    if (is_command(data[0])) commands.push_back({data[0], read_numbers(data.substr(1, end - 1))});
    data.remove_prefix(end);
  }
  return commands;
}

// Adds one path command to Cairo's current path. A move to several points moves to the first one,
// and draws lines to the others.
class PathWriter {
 public:
  explicit PathWriter(cairo_t* context) : context_(context) {}

  void add(const PathCommand& command) {
    const char kind = static_cast<char>(std::toupper(static_cast<unsigned char>(command.name)));
    is_relative_ = kind != command.name;
    if (kind == 'Z') return cairo_close_path(context_);
    const std::size_t step = kind == 'C' ? 6 : kind == 'H' || kind == 'V' ? 1 : 2;
    for (std::size_t i = 0; i + step <= command.numbers.size(); i += step)
      add(kind == 'M' && i > 0 ? 'L' : kind, &command.numbers[i]);
  }

 private:
  void add(char kind, const double* n) {
    double x = 0, y = 0;  // origin of relative coordinates
    if (cairo_has_current_point(context_)) cairo_get_current_point(context_, &x, &y);
    const double from_x = is_relative_ ? x : 0, from_y = is_relative_ ? y : 0;
    switch (kind) {
      case 'M':
        return cairo_move_to(context_, from_x + n[0], from_y + n[1]);
      case 'L':
        return cairo_line_to(context_, from_x + n[0], from_y + n[1]);
      case 'H':
        return cairo_line_to(context_, from_x + n[0], y);
      case 'V':
        return cairo_line_to(context_, x, from_y + n[0]);
      case 'C':
        return cairo_curve_to(context_, from_x + n[0], from_y + n[1], from_x + n[2], from_y + n[3],
                              from_x + n[4], from_y + n[5]);
      default:
        throw base::InvariantBroken(fmt::format("SVG: found the path command {}", kind));
    }
  }

  cairo_t* context_;
  bool is_relative_ = false;
};

// Draws the elements of one SVG.
class SvgPainter {
 public:
  SvgPainter(cairo_t* context, const XmlElement& root) : context_(context) { collect(root); }

  void draw_children(const XmlElement& element, const SvgStyle& style) {
    for (const auto& child : element.children) draw(child, style);
  }

 private:
  void collect(const XmlElement& element) {
    if (const auto id = element.attribute("id"); !id.empty()) by_id_[id] = &element;
    for (const auto& child : element.children) collect(child);
  }

  void draw(const XmlElement& element, const SvgStyle& outer) {
    const auto& name = element.name;
    if (name == "title" || name == "desc" || name == "defs" || name == "style") return;
    const auto style = inherit_style(element, outer);
    cairo_save(context_);
    const auto m = read_transform(element.attribute("transform"));
    const cairo_matrix_t matrix{m[0], m[1], m[2], m[3], m[4], m[5]};
    cairo_transform(context_, &matrix);
    if (name == "g" || name == "a")
      draw_children(element, style);
    else if (name == "use")
      draw_use(element, style);
    else if (name == "text")
      draw_text(element, style);
    else
      draw_shape(element, style);
    cairo_restore(context_);
  }

  void draw_use(const XmlElement& element, const SvgStyle& style) {
    cairo_translate(context_, read_number(element, "x"), read_number(element, "y"));
    const auto id = element.attribute("href");
    const auto used = by_id_.find(id.empty() ? id : id.substr(1));
    if (used == by_id_.end())
      throw base::InvariantBroken(fmt::format("SVG: found no element {}", base::quote(id)));
    draw(*used->second, style);
  }

  void draw_shape(const XmlElement& element, const SvgStyle& style) {
    const auto at = [&](const char* key) { return read_number(element, key); };
    if (element.name == "rect")
      cairo_rectangle(context_, at("x"), at("y"), at("width"), at("height"));
    else if (element.name == "circle")
      add_ellipse(at("cx"), at("cy"), at("r"), at("r"));
    else if (element.name == "ellipse")
      add_ellipse(at("cx"), at("cy"), at("rx"), at("ry"));
    else if (element.name == "polygon" || element.name == "polyline")
      add_polygon(read_numbers(element.attribute("points")), element.name == "polygon");
    else if (element.name == "path")
      add_path(element.attribute("d"));
    else
      throw base::InvariantBroken(fmt::format("SVG: found the element <{}>", element.name));
    paint(style);
  }

  void add_ellipse(double x, double y, double rx, double ry) {
    if (rx <= 0 || ry <= 0) return;
    cairo_save(context_);
    cairo_translate(context_, x, y);
    cairo_scale(context_, rx, ry);
    cairo_new_sub_path(context_);
    cairo_arc(context_, 0, 0, 1, 0, FULL_TURN);
    cairo_close_path(context_);
    cairo_restore(context_);
  }

  void add_polygon(const std::vector<double>& points, bool is_closed) {
    for (std::size_t i = 0; i + 1 < points.size(); i += 2)
      cairo_line_to(context_, points[i], points[i + 1]);
    if (is_closed) cairo_close_path(context_);
  }

  void add_path(std::string_view data) {
    PathWriter writer(context_);
    for (const auto& command : split_path(data)) writer.add(command);
  }

  void set_colour(const SvgColour& c, double opacity) {
    if (opacity < 1)
      cairo_set_source_rgba(context_, c[0], c[1], c[2], opacity);
    else
      cairo_set_source_rgb(context_, c[0], c[1], c[2]);
  }

  // Fills and strokes the current path, and clears it.
  void paint(const SvgStyle& style) {
    if (style.fill) {
      set_colour(*style.fill, style.fill_opacity);
      cairo_fill_preserve(context_);
    }
    if (style.stroke && style.stroke_width > 0) {
      set_colour(*style.stroke, style.stroke_opacity);
      cairo_set_line_width(context_, style.stroke_width);
      cairo_set_dash(context_, style.dashes.data(), static_cast<int>(style.dashes.size()), 0);
      cairo_set_line_cap(context_,
                         style.cap == "round" ? CAIRO_LINE_CAP_ROUND : CAIRO_LINE_CAP_BUTT);
      cairo_set_line_join(context_,
                          style.join == "round" ? CAIRO_LINE_JOIN_ROUND : CAIRO_LINE_JOIN_MITER);
      cairo_stroke_preserve(context_);
    }
    cairo_new_path(context_);
  }

  // Draws the words of a <text> element. gnuplot puts them into <tspan> elements, one for each part
  // with its own font.
  void draw_text(const XmlElement& element, const SvgStyle& style) {
    if (!element.children.empty())
      for (const auto& part : element.children)
        show_words(part.text, element, inherit_style(part, style));
    if (!element.text.empty()) show_words(element.text, element, style);
  }

  void show_words(const std::string& words, const XmlElement& element, const SvgStyle& style) {
    if (!style.fill) return;
    cairo_select_font_face(context_, style.font.c_str(),
                           style.is_italic ? CAIRO_FONT_SLANT_ITALIC : CAIRO_FONT_SLANT_NORMAL,
                           style.is_bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(context_, style.font_size);
    cairo_text_extents_t extents{};
    cairo_text_extents(context_, words.c_str(), &extents);
    const double share = style.anchor == "middle" ? 0.5 : style.anchor == "end" ? 1 : 0;
    cairo_move_to(context_, read_number(element, "x") - share * extents.x_advance,
                  read_number(element, "y"));
    set_colour(*style.fill, style.fill_opacity);
    // A text with a stroke gets an outline in this colour; its letters are then drawn on top.
    if (style.stroke) {
      cairo_text_path(context_, words.c_str());
      SvgStyle outline = style;
      outline.fill.reset();
      paint(outline);
      return draw_again(words, element, style);
    }
    cairo_show_text(context_, words.c_str());
    cairo_new_path(context_);
  }

  void draw_again(const std::string& words, const XmlElement& element, SvgStyle style) {
    style.stroke.reset();
    show_words(words, element, style);
  }

  cairo_t* context_;
  std::map<std::string, const XmlElement*> by_id_;
};

cairo_status_t append_bytes(void* to, const unsigned char* bytes, unsigned length) {
  static_cast<std::string*>(to)->append(reinterpret_cast<const char*>(bytes), length);
  return CAIRO_STATUS_SUCCESS;
}

}  // namespace

std::string svg_to_pdf(const std::string& svg, const std::string& name) {
  constexpr int DEPTH = 64;
  // The reader of XML omits attributes whose names have a prefix, such as xlink:href.
  const auto root =
      topologies::read_xml(boost::replace_all_copy(svg, "xlink:href", "href"), DEPTH, name);
  const auto box = read_numbers(root.attribute("viewBox"));
  base::check_equal("numbers in the viewBox", box.size(), std::size_t(4));
  const auto find_length = [&](const char* key, double standard) {
    const auto text = root.attribute(key);
    return text.empty() ? 0.75 * standard : read_length(text);
  };
  const double width = find_length("width", box[2]), height = find_length("height", box[3]);
  std::string pdf;
  const std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> surface(
      cairo_pdf_surface_create_for_stream(append_bytes, &pdf, width, height),
      &cairo_surface_destroy);
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATE_DATE, "");
  const std::unique_ptr<cairo_t, decltype(&cairo_destroy)> context(cairo_create(surface.get()),
                                                                   &cairo_destroy);
  cairo_scale(context.get(), width / box[2], height / box[3]);
  cairo_translate(context.get(), -box[0], -box[1]);
  SvgPainter(context.get(), root).draw_children(root, inherit_style(root, {}));
  cairo_surface_finish(surface.get());
  for (const auto status : {cairo_status(context.get()), cairo_surface_status(surface.get())})
    if (status != CAIRO_STATUS_SUCCESS)
      throw std::runtime_error(fmt::format("{}: Cairo: {}", name, cairo_status_to_string(status)));
  return pdf;
}

void save_figure(const std::filesystem::path& folder, const std::string& name,
                 const std::string& svg) {
  const auto file = folder / name;
  base::save_whole(file.string() + ".svg", svg);
  base::save_whole(file.string() + ".pdf", svg_to_pdf(svg, name));
}

}  // namespace laboratory
