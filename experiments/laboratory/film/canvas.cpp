#include "experiments/laboratory/film/canvas.hpp"

#include <cairo/cairo.h>
#include <fmt/format.h>

#include <numbers>
#include <stdexcept>

#include "base/text.hpp"

namespace laboratory {

using topologies::Place;

namespace {

constexpr const char* FONT = "DejaVu Sans";

// Selects grey-level antialiasing without hinting, so that text does not depend on the settings of
// the host's desktop.
void choose_font(cairo_t* context) {
  cairo_select_font_face(context, FONT, CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  cairo_font_options_t* options = cairo_font_options_create();
  cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
  cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  cairo_set_font_options(context, options);
  cairo_font_options_destroy(options);
}

void check(cairo_status_t status) {
  if (status != CAIRO_STATUS_SUCCESS)
    throw std::runtime_error(fmt::format("Cairo: {}", cairo_status_to_string(status)));
}

}  // namespace

struct Canvas::Cairo {
  cairo_surface_t* surface;
  cairo_t* context;

  Cairo(int width, int height)
      : surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height)),
        context(cairo_create(surface)) {
    check(cairo_status(context));
    choose_font(context);
  }
  Cairo(const Cairo&) = delete;
  Cairo& operator=(const Cairo&) = delete;
  ~Cairo() {
    cairo_destroy(context);
    cairo_surface_destroy(surface);
  }
};

void Canvas::End::operator()(Cairo* cairo) const { delete cairo; }

Canvas::Canvas(int width, int height)
    : width_(width), height_(height), cairo_(new Cairo(width, height)) {
  fill({0, 0, static_cast<double>(width), static_cast<double>(height)}, WHITE);
}

void Canvas::set(const Colour& colour, double line) {
  cairo_set_source_rgb(cairo_->context, colour[0], colour[1], colour[2]);
  cairo_set_line_width(cairo_->context, line);
}

void Canvas::fill(const Rectangle& area, const Colour& colour) {
  set(colour);
  cairo_rectangle(cairo_->context, area.x, area.y, area.width, area.height);
  cairo_fill(cairo_->context);
}

void Canvas::outline(const Rectangle& area, const Colour& colour, double line) {
  set(colour, line);
  cairo_rectangle(cairo_->context, area.x, area.y, area.width, area.height);
  cairo_stroke(cairo_->context);
}

void Canvas::line(double x0, double y0, double x1, double y1, const Colour& colour, double line) {
  set(colour, line);
  cairo_move_to(cairo_->context, x0, y0);
  cairo_line_to(cairo_->context, x1, y1);
  cairo_stroke(cairo_->context);
}

void Canvas::disc(const Place& middle, double radius, const Colour& colour) {
  set(colour);
  cairo_new_sub_path(cairo_->context);
  cairo_arc(cairo_->context, middle.x, middle.y, radius, 0, 2 * std::numbers::pi);
  cairo_fill(cairo_->context);
}

void Canvas::ring(const Place& middle, double radius, const Colour& colour, double line) {
  set(colour, line);
  cairo_new_sub_path(cairo_->context);
  cairo_arc(cairo_->context, middle.x, middle.y, radius, 0, 2 * std::numbers::pi);
  cairo_stroke(cairo_->context);
}

void Canvas::curve(const std::array<Place, 4>& points, const Colour& colour, double line) {
  set(colour, line);
  const auto& [p0, p1, p2, p3] = points;
  cairo_move_to(cairo_->context, p0.x, p0.y);
  cairo_curve_to(cairo_->context, p1.x, p1.y, p2.x, p2.y, p3.x, p3.y);
  cairo_stroke(cairo_->context);
}

void Canvas::text(double x, double y, const std::string& words, double size, Align align,
                  const Colour& colour) {
  set(colour);
  cairo_set_font_size(cairo_->context, size);
  const double width = align == Align::left ? 0 : text_width(words, size);
  cairo_move_to(cairo_->context, x - (align == Align::middle ? width / 2 : width), y);
  cairo_show_text(cairo_->context, words.c_str());
  check(cairo_status(cairo_->context));
}

void Canvas::text_on_lines(double x, double y, const std::string& words, double size, Align align) {
  set(WHITE, 3);
  cairo_set_font_size(cairo_->context, size);
  const double width = align == Align::left ? 0 : text_width(words, size);
  cairo_move_to(cairo_->context, x - (align == Align::middle ? width / 2 : width), y);
  cairo_text_path(cairo_->context, words.c_str());
  cairo_stroke(cairo_->context);
  text(x, y, words, size, align);
}

void Canvas::picture(int x, int y, const renderer::Bitmap& bitmap, int factor) {
  cairo_surface_flush(cairo_->surface);
  auto* const bytes = cairo_image_surface_get_data(cairo_->surface);
  const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(cairo_->surface));
  for (int row = 0; row < bitmap.height * factor; ++row) {
    auto* to = reinterpret_cast<std::uint32_t*>(bytes + static_cast<std::size_t>(y + row) * stride);
    const auto* from = bitmap.rgb8.data() + 3 * static_cast<std::size_t>(bitmap.width) *
                                                static_cast<std::size_t>(row / factor);
    for (int column = 0; column < bitmap.width * factor; ++column) {
      const auto* pixel = from + 3 * (column / factor);
      to[x + column] = static_cast<std::uint32_t>(pixel[0]) << 16 |
                       static_cast<std::uint32_t>(pixel[1]) << 8 | pixel[2];
    }
  }
  cairo_surface_mark_dirty(cairo_->surface);
}

renderer::Bitmap Canvas::bitmap() const {
  cairo_surface_flush(cairo_->surface);
  const auto* const bytes = cairo_image_surface_get_data(cairo_->surface);
  const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(cairo_->surface));
  renderer::Bitmap bitmap{width_, height_, {}};
  bitmap.rgb8.reserve(3 * static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
  for (int y = 0; y < height_; ++y) {
    const auto* row =
        reinterpret_cast<const std::uint32_t*>(bytes + static_cast<std::size_t>(y) * stride);
    for (int x = 0; x < width_; ++x)
      for (const int shift : {16, 8, 0})
        bitmap.rgb8.push_back(static_cast<std::uint8_t>(row[x] >> shift));
  }
  return bitmap;
}

double text_width(const std::string& words, double size) {
  cairo_surface_t* surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, 1, 1);
  cairo_t* context = cairo_create(surface);
  choose_font(context);
  cairo_set_font_size(context, size);
  cairo_text_extents_t extents{};
  cairo_text_extents(context, words.c_str(), &extents);
  const auto status = cairo_status(context);
  cairo_destroy(context);
  cairo_surface_destroy(surface);
  check(status);
  return extents.x_advance;
}

std::string shorten_to(const std::string& words, double size, double width) {
  if (text_width(words, size) <= width) return words;
  std::string shorter = words;
  const auto is_inside = [](char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; };
  while (!shorter.empty() && text_width(shorter + "…", size) > width) {
    while (shorter.size() > 1 && is_inside(shorter.back())) shorter.pop_back();
    shorter.pop_back();
  }
  return shorter + "…";
}

}  // namespace laboratory
