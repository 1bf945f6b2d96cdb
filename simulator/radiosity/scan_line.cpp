// A line of a room's picture, interpolated in two ways, beside a reference: figure 3.9.
#include <algorithm>

#include "base/errors.hpp"
#include "simulator/declare/support.hpp"
#include "simulator/radiosity/compare_pictures.hpp"

namespace programs {

namespace {

using radiosity::Picture;
using radiosity::Reconstruction;

// One of the pictures: what is displayed of a line, and the radiosity.
struct Line {
  std::string name;
  std::vector<double> displayed, linear;
};

Line take_line(const Setup& setup, const std::string& name, const Picture& picture,
               const radiosity::Display& display, int y) {
  const auto channel = static_cast<std::size_t>(setup.whole("channel"));
  const auto shown = make_rgb8(picture, display);
  Line line{name, {}, {}};
  for (int x = 0; x < picture.width; ++x) {
    const auto i = static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                   static_cast<std::size_t>(x);
    const auto& pixel = picture.pixels[i];
    line.displayed.push_back(shown[3 * i + channel]);
    line.linear.push_back(channel == 0 ? pixel.r : channel == 1 ? pixel.g : pixel.b);
  }
  return line;
}

LitRoom solve_scene(const Setup& setup) {
  LitRoom lit{load_meshed_room(setup), {}};
  const auto solution = solve(lit.room.mesh, solve_params(setup));
  lit.vertices = light_vertices(setup, lit.room.mesh, solution.vertices, solution.ambient);
  return lit;
}

Rows run(const Setup& setup) {
  const auto lit = solve_scene(setup);
  const auto known = solve_reference(setup);
  const Camera camera(setup, lit.room.room);
  const auto twist = reconstruction_params(setup, "reference_reconstruction").twist;
  const auto bilinear = camera.take(lit, {Reconstruction::bilinear, twist});
  const auto bicubic = camera.take(lit, {Reconstruction::bicubic, twist});
  const auto reference =
      camera.take(*known, reconstruction_params(setup, "reference_reconstruction"));
  auto emitters = camera.find_emitters(lit.room.mesh);
  const auto others = camera.find_emitters(known->room.mesh);
  for (std::size_t i = 0; i < emitters.size(); ++i) emitters[i] = emitters[i] || others[i];
  const auto display = make_display(setup, reference, emitters);
  const auto asked = static_cast<int>(setup.whole("line"));
  if (asked >= reference.height)
    throw base::BadInput(fmt::format(
        "program.line: found {}, expected a line of the picture, 0 to {}, or -1 for the middle",
        asked, reference.height - 1));
  const int y = asked < 0 ? reference.height / 2 : asked;
  const Line lines[] = {take_line(setup, "bilinear", bilinear, display, y),
                        take_line(setup, "bicubic", bicubic, display, y),
                        take_line(setup, "fine", reference, display, y)};
  Rows rows;
  for (int x = 0; x < reference.width; ++x) {
    const auto i = static_cast<std::size_t>(x);
    Row& row = rows.rows.emplace_back(Row{{"x", x}});
    for (const Line& line : lines) row.emplace_back(line.name, line.displayed[i]);
    for (const Line& line : lines) row.emplace_back(line.name + "_linear", line.linear[i]);
    row.emplace_back("emits", emitters[static_cast<std::size_t>(y * reference.width + x)]);
  }
  return rows;
}

void check(const Setup& setup) {
  check_rooms(setup);
  if (setup.path("reference").empty() && setup.whole("reference_refine") == 0)
    throw base::BadInput(
        "program.reference_refine: found 0 and no program.reference, expected one of them");
}

std::vector<Parameter> parameters() {
  auto all = solution_parameters();
  for (const auto& more : {view_parameters(), reference_parameters()})
    all.insert(all.end(), more.begin(), more.end());
  all.push_back({"line", -1, -1, 65535, true, "from the top; -1: the middle"});
  all.push_back(make_choice("channel", {"red", "green", "blue"}, "of the pixels"));
  return all;
}

}  // namespace

Pattern make_scan_line() {
  return {.name = "scan_line",
          .help =
              "a line of a room's picture, without a machine: at each pixel x what is displayed, "
              "0..255, and the radiosity, by bilinear and bicubic interpolation and of a "
              "reference (fine); emits: it shows what emits",
          .uses_topology = false,
          .parameters = parameters(),
          .run = &run,
          .parts = {"x"},
          .check = &check};
}

}  // namespace programs
