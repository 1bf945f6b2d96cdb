// One line of a room's picture, interpolated in two ways, and the same line of a reference (thesis,
// figure 3.9).

#include "simulator/parallel_radiosity/program.hpp"

namespace parallel_radiosity {

using programs::Outcome;
using programs::Setup;
using radiosity::Picture;

namespace {

enum class Channel : std::uint8_t { red, green, blue };

struct LineParams {
  RoomParams room;
  int line = -1;
  Channel channel = Channel::red;
};

constexpr std::array<const char*, 3> PICTURES = {"bilinear", "bicubic", "fine"};

// One pixel of the line in all three pictures: the two interpolations and the reference.
struct Pixel {
  int x = 0;
  std::array<int, 3> displayed{};  // displayed values, 0 to 255
  std::array<double, 3> linear{};
  bool emits = false;
};

// Number of the line, counted from 0 at the top.
int find_line(const LineParams& params, const Picture& picture) {
  if (params.line >= picture.height)
    base::refuse("program.line",
                 "found {}, expected a line of the picture, 0 to {}, or -1 for the middle",
                 params.line, picture.height - 1);
  return params.line < 0 ? picture.height / 2 : params.line;
}

// Adds the values of the picture with index `number`. The line starts at pixel `first` of the
// picture.
void add_picture(std::vector<Pixel>& line, std::size_t number, const Picture& picture,
                 const radiosity::Display& display, std::size_t first, Channel channel) {
  const auto shown = make_rgb8(picture, display);
  const auto colour = static_cast<std::size_t>(channel);
  for (std::size_t x = 0; x < line.size(); ++x) {
    const auto& [r, g, b] = picture.pixels[first + x];
    line[x].displayed[number] = shown[3 * (first + x) + colour];
    line[x].linear[number] = channel == Channel::red ? r : channel == Channel::green ? g : b;
  }
}

Outcome<Pixel> run_line(const Setup&, const LineParams& params) {
  const auto& room_params = params.room;
  const auto room = load_scene(room_params);
  const auto lit = light_room(room, room_params.light);
  const auto fine = solve_reference(room_params).value();
  const auto take = [&](radiosity::Reconstruction kind) {
    return trace_picture(lit, {kind, room_params.reconstruction.twist}, room.view,
                         room_params.picture);
  };
  const std::array<Picture, 3> pictures = {take(radiosity::Reconstruction::bilinear),
                                           take(radiosity::Reconstruction::bicubic),
                                           trace_reference(room_params, fine, room.view)};
  const auto& reference = pictures.back();
  const auto emitters = find_emitters(room_params, room.view, lit.mesh, fine.mesh);
  const auto display = fit(room_params.display, reference, emitters);
  const auto width = static_cast<std::size_t>(reference.width);
  const auto first = static_cast<std::size_t>(find_line(params, reference)) * width;
  std::vector<Pixel> line(width);
  for (std::size_t i = 0; i < pictures.size(); ++i)
    add_picture(line, i, pictures[i], display, first, params.channel);
  for (std::size_t x = 0; x < width; ++x) {
    line[x].x = static_cast<int>(x);
    line[x].emits = emitters[first + x];
  }
  return Outcome<Pixel>(std::move(line));
}

void check_line(const Setup&, const LineParams& params) {
  check(params.room);
  if (params.room.reference.path.empty() && params.room.reference_refine == 0)
    base::refuse("program.reference_refine",
                 "found 0 and no program.reference, expected one of them");
}

base::Fields<LineParams> make_line_fields() {
  using D = base::Declare<LineParams>;
  static const base::Names<Channel> CHANNELS = {
      {"red", Channel::red}, {"green", Channel::green}, {"blue", Channel::blue}};
  const auto room = base::join(solution_fields(), {view_fields(), reference_fields()});
  return base::join(
      base::lift_all<LineParams>(room, &LineParams::room),
      {{D::whole("line", &LineParams::line, -1, 65535, "",
                 "number of the line, from the top; -1: the middle"),
        D::choice("channel", &LineParams::channel, CHANNELS, "colour of the pixels")}});
}

base::Columns<Pixel> make_line_columns() {
  base::Columns<Pixel> all = {base::column("x", &Pixel::x, "pixel, from the left")};
  const auto add = [&](auto values, const std::string& suffix, const std::string& what) {
    for (std::size_t i = 0; i < PICTURES.size(); ++i)
      all.push_back(base::column<Pixel>(
          PICTURES[i] + suffix, [=](const Pixel& p) { return (p.*values)[i]; },
          what + (i < 2 ? " with this interpolation" : " of the reference")));
  };
  add(&Pixel::displayed, "", "displayed value, 0 to 255,");
  add(&Pixel::linear, "_linear", "radiosity");
  all.push_back(
      base::column("emits", &Pixel::emits, "1 if the pixel shows a light source, else 0"));
  return all;
}

}  // namespace

programs::Program make_scan_line() {
  return programs::make_program<LineParams, Pixel>(
      {.name = "scan_line",
       .help = "a scan line of a room by bilinear and bicubic interpolation, and of a reference; "
               "nothing is simulated",
       .fields = make_line_fields(),
       .columns = make_line_columns(),
       .parts = {"x"},
       .run = &run_line,
       .check = &check_line});
}

}  // namespace parallel_radiosity
