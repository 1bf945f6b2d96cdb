#include "tests/reference/deviation.hpp"

#include <numeric>

#include "renderer/scene/require.hpp"

namespace radiosity::reference {

namespace {

// Pixels darker than this share of the mean radiosity have errors relative to that share, not to
// their own radiosity.
constexpr double DARK = 0.02;
constexpr double TOO_NEAR = 5e-6;  // least angle between a ray and an edge, in radians

double grey(const Rgb& colour) { return (colour.r + colour.g + colour.b) / 3; }

bool is_lit(const Reference& reference, std::size_t i) {
  return reference.faces[i] != 0 && !reference.emits[i];
}

double eval_mean(const Reference& reference) {
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < reference.faces.size(); ++i)
    if (is_lit(reference, i)) sum += grey(reference.picture.pixels[i]), ++count;
  return count > 0 ? sum / count : 0;
}

// The radiosity by which the error of a pixel is divided.
double eval_scale(const Reference& reference, double mean, std::size_t i) {
  return std::max({grey(reference.picture.pixels[i]), DARK * mean, 1e-300});
}

double eval_difference(const Picture& picture, const Reference& reference, std::size_t i) {
  return grey(picture.pixels[i]) - grey(reference.picture.pixels[i]);
}

// Calls f(index) for each of the up to eight neighbours of a pixel.
void each_neighbour(std::size_t i, int width, std::size_t count, const auto& f) {
  const auto w = static_cast<std::ptrdiff_t>(width);
  const auto at = static_cast<std::ptrdiff_t>(i), x = at % w;
  for (std::ptrdiff_t dy = -1; dy <= 1; ++dy)
    for (std::ptrdiff_t dx = -1; dx <= 1; ++dx) {
      const std::ptrdiff_t other = at + dy * w + dx;
      if (x + dx < 0 || x + dx >= w || other < 0 || other >= static_cast<std::ptrdiff_t>(count) ||
          other == at)
        continue;
      f(static_cast<std::size_t>(other));
    }
}

// The quantile of the values: at least this share of them is not larger. 0 if there are no values.
double find_quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  std::ranges::sort(values);
  const double rank = std::ceil(share * static_cast<double>(values.size()));
  return values[static_cast<std::size_t>(rank) - 1];
}

// True if a ray passes the edge from a to b at an angular distance of at most TOO_NEAR.
bool grazes(const renderer::Ray& ray, const Vec& a, const Vec& b) {
  const Vec to_a = a - ray.origin, to_b = b - ray.origin, across = cross(to_a, to_b);
  const Vec way = normalize(ray.direction);
  return std::abs(dot(across, way)) <= TOO_NEAR * length(across) &&
         dot(cross(to_a, way), across) >= 0 && dot(cross(way, to_b), across) >= 0;
}

void check_size(const Picture& picture, const Reference& reference) {
  const auto write = [](const Picture& p) {
    return fmt::format("{}x{} pixels", p.width, p.height);
  };
  renderer::require(
      picture.width == reference.picture.width && picture.height == reference.picture.height,
      write(picture), "the reference's " + write(reference.picture));
}

}  // namespace

void leave_out_edges(Reference& reference, const Room& room) {
  const renderer::View view = make_image_plane(room.view);
  const auto pixels = make_pixels(reference.picture.width, reference.picture.height);
  for (int y = 0; y < pixels.height; ++y)
    for (int x = 0; x < pixels.width; ++x) {
      const renderer::Ray ray = make_primary(view, pixels, x, y);
      for (const Face& face : room.faces)
        for (std::size_t i = 0; i < face.corners.size(); ++i)
          if (grazes(ray, face.corners[i], face.corners[(i + 1) % face.corners.size()]))
            reference.faces[static_cast<std::size_t>(y) * static_cast<std::size_t>(pixels.width) +
                            static_cast<std::size_t>(x)] = 0;
    }
}

std::vector<bool> find_inner(const Reference& reference) {
  const std::size_t count = reference.faces.size();
  std::vector<bool> inner(count);
  for (std::size_t i = 0; i < count; ++i) {
    bool same = is_lit(reference, i);
    each_neighbour(i, reference.picture.width, count,
                   [&](std::size_t n) { same = same && reference.faces[n] == reference.faces[i]; });
    inner[i] = same;
  }
  return inner;
}

std::vector<bool> find_off(const Picture& picture, const Reference& reference) {
  check_size(picture, reference);
  const double mean = eval_mean(reference);
  std::vector<bool> off(reference.faces.size());
  for (std::size_t i = 0; i < off.size(); ++i)
    off[i] = is_lit(reference, i) &&
             std::abs(eval_difference(picture, reference, i)) - 2 * reference.error[i] >=
                 OFF * eval_scale(reference, mean, i);
  return off;
}

int count_largest_group(const std::vector<bool>& marked, int width) {
  std::vector<bool> left = marked;
  int largest = 0;
  std::vector<std::size_t> stack;
  for (std::size_t first = 0; first < left.size(); ++first) {
    int size = 0;
    const auto take = [&](std::size_t i) {
      if (!left[i]) return;
      left[i] = false;
      stack.push_back(i);
      ++size;
    };
    take(first);
    while (!stack.empty()) {
      const std::size_t i = stack.back();
      stack.pop_back();
      each_neighbour(i, width, left.size(), take);
    }
    largest = std::max(largest, size);
  }
  return largest;
}

Deviation compare(const Picture& picture, const Reference& reference) {
  check_size(picture, reference);
  const double mean = std::max(eval_mean(reference), 1e-300);
  const std::vector<bool> inner = find_inner(reference);
  double count = 0, sum = 0, squares = 0, noise = 0;
  std::vector<double> within, at_edges;
  for (std::size_t i = 0; i < inner.size(); ++i) {
    if (!is_lit(reference, i)) continue;
    const double off = eval_difference(picture, reference, i), s = reference.error[i];
    ++count;
    sum += off;
    squares += off * off;
    noise += s * s;
    (inner[i] ? within : at_edges)
        .push_back(std::sqrt(std::max(0.0, off * off - s * s)) / eval_scale(reference, mean, i));
  }
  Deviation found;
  found.group = count_largest_group(find_off(picture, reference), picture.width);
  if (count == 0) return found;
  found.rmse = std::sqrt(std::max(0.0, squares - noise) / count) / mean;
  found.bias = sum / count / mean;
  found.noise = std::sqrt(noise / count) / mean;
  found.p99 = find_quantile(within, 0.99);
  found.worst = find_quantile(within, 1);
  found.edges = find_quantile(at_edges, 0.99);
  return found;
}

Picture draw_deviation(const Picture& picture, const Reference& reference, double full) {
  check_size(picture, reference);
  const double mean = eval_mean(reference);
  Picture drawn{picture.width, picture.height, std::vector<Rgb>(picture.pixels.size())};
  for (std::size_t i = 0; i < drawn.pixels.size(); ++i) {
    if (!is_lit(reference, i)) continue;
    const double error =
        eval_difference(picture, reference, i) / eval_scale(reference, mean, i) / full;
    const double pale = 1 - std::min(1.0, std::abs(error));
    drawn.pixels[i] = error > 0 ? Rgb{1, pale, pale} : Rgb{pale, pale, 1};
  }
  return drawn;
}

}  // namespace radiosity::reference
