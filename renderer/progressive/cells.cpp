#include "renderer/progressive/cells.hpp"

#include <bit>

namespace renderer::progressive {

namespace {

Rgb min(const Rgb& a, const Rgb& b) {
  return {std::min(a.r, b.r), std::min(a.g, b.g), std::min(a.b, b.b)};
}
Rgb max(const Rgb& a, const Rgb& b) {
  return {std::max(a.r, b.r), std::max(a.g, b.g), std::max(a.b, b.b)};
}
Rgb mix(const Rgb& a, const Rgb& b, double share) { return (1 - share) * a + share * b; }

// Divides an interval after `half` steps. Returns the starts of the parts, and the end.
std::vector<int> cut(int from, int to, int half) {
  if (from + half < to) return {from, from + half, to};
  return {from, to};
}

// The starts of the cells along a side of the image, and the end of the last cell.
std::vector<int> cut_image(int pixels, int side) {
  std::vector<int> cuts;
  for (long long at = 0; at < pixels - 1; at += side) cuts.push_back(static_cast<int>(at));
  if (cuts.empty()) cuts.push_back(0);
  cuts.push_back(pixels - 1);
  return cuts;
}

void append_cells(const std::vector<int>& x, const std::vector<int>& y, std::vector<Cell>& cells) {
  for (std::size_t row = 0; row + 1 < y.size(); ++row)
    for (std::size_t column = 0; column + 1 < x.size(); ++column)
      cells.push_back({x[column], y[row], x[column + 1], y[row + 1]});
}

// Colours of the `count` pixels along one side of a cell, interpolated linearly between samples.
// Both ends of the side must be samples.
template <class At>
std::vector<Rgb> make_side(int count, const Sampled& sampled, const At& pixel) {
  std::vector<Rgb> side(static_cast<std::size_t>(count));
  int last = 0;
  for (int i = 0; i < count; ++i) {
    const auto [x, y] = pixel(i);
    if (!sampled.has(x, y)) continue;
    const Rgb here = sampled.get(x, y);
    side[static_cast<std::size_t>(i)] = here;
    const Rgb before = side[static_cast<std::size_t>(last)];
    for (int j = last + 1; j < i; ++j)
      side[static_cast<std::size_t>(j)] =
          mix(before, here, static_cast<double>(j - last) / static_cast<double>(i - last));
    last = i;
  }
  return side;
}

}  // namespace

int get_size(const Cell& c) {
  const int side = std::max({c.x1 - c.x0, c.y1 - c.y0, 1});
  return static_cast<int>(std::bit_ceil(static_cast<unsigned>(side)));
}

std::vector<Cell> make_cells(int width, int height, int side) {
  std::vector<Cell> cells;
  append_cells(cut_image(width, side), cut_image(height, side), cells);
  return cells;
}

std::vector<Cell> divide(const Cell& c) {
  const int half = get_size(c) / 2;
  std::vector<Cell> cells;
  append_cells(cut(c.x0, c.x1, half), cut(c.y0, c.y1, half), cells);
  return cells;
}

bool meets(const Cell& c, const Area& area) {
  return c.x0 < area.x + area.width && c.x1 >= area.x && c.y0 < area.y + area.height &&
         c.y1 >= area.y;
}

Range widen(const Range& range, const Rgb& colour) {
  return {min(range.least, colour), max(range.greatest, colour)};
}

Range find_range(const Cell& c, const Sampled& sampled) {
  const Rgb corner = sampled.get(c.x0, c.y0);
  Range range{corner, corner};
  const auto look = [&](int x, int y) {
    if (!sampled.has(x, y)) return;
    const Rgb colour = sampled.get(x, y);
    range = widen(range, colour);
  };
  for (int x = c.x0; x <= c.x1; ++x) {
    look(x, c.y0);
    look(x, c.y1);
  }
  for (int y = c.y0 + 1; y < c.y1; ++y) {
    look(c.x0, y);
    look(c.x1, y);
  }
  return range;
}

double eval_contrast(double least, double greatest) {
  return greatest + least > 0 ? (greatest - least) / (greatest + least) : 0;
}

double eval_contrast(const Range& range) {
  const Rgb &a = range.least, &b = range.greatest;
  return std::max({eval_contrast(a.r, b.r), eval_contrast(a.g, b.g), eval_contrast(a.b, b.b)});
}

void interpolate(const Cell& c, const Sampled& sampled, Samples& picture) {
  const int width = c.x1 - c.x0, height = c.y1 - c.y0;
  const auto along_x = [&](int y) {
    return make_side(width + 1, sampled, [&](int i) { return std::pair(c.x0 + i, y); });
  };
  const auto along_y = [&](int x) {
    return make_side(height + 1, sampled, [&](int i) { return std::pair(x, c.y0 + i); });
  };
  const auto top = along_x(c.y0), bottom = along_x(c.y1);
  const auto left = along_y(c.x0), right = along_y(c.x1);
  const Range range = find_range(c, sampled);
  for (int row = 0; row <= height; ++row)
    for (int column = 0; column <= width; ++column) {
      const int x = c.x0 + column, y = c.y0 + row;
      if (sampled.has(x, y)) continue;
      const double u = width > 0 ? static_cast<double>(column) / width : 0;
      const double v = height > 0 ? static_cast<double>(row) / height : 0;
      const auto i = static_cast<std::size_t>(column), j = static_cast<std::size_t>(row);
      const Rgb corners =
          mix(mix(top.front(), top.back(), u), mix(bottom.front(), bottom.back(), u), v);
      const Rgb colour = mix(left[j], right[j], u) + mix(top[i], bottom[i], v) + -1.0 * corners;
      const auto pixel = static_cast<std::uint32_t>(sampled.index(x, y));
      picture.sums[pixel] = {};
      picture.add(pixel, min(max(colour, range.least), range.greatest));
    }
}

}  // namespace renderer::progressive
