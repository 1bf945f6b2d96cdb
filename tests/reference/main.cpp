// Compares pictures by radiosity with reference pictures by a path tracer. Prints one line for each
// room and each way of solving and showing it, and a summary.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <filesystem>

#include "base/text.hpp"
#include "base/whole_file.hpp"
#include "experiments/laboratory/options/options.hpp"
#include "renderer/radiosity/creases/creases.hpp"
#include "renderer/radiosity/files/load_room.hpp"
#include "renderer/radiosity/show/adapt.hpp"
#include "renderer/radiosity/show/display.hpp"
#include "tests/reference/cache.hpp"
#include "tests/reference/deviation.hpp"
#include "tests/reference/room_kinds.hpp"

namespace radiosity::reference {
namespace {

struct Options {
  std::vector<std::string> files;
  std::string seeds, kind = "blocks", size = "160x120", cache, pictures;
  std::vector<int> refine{1};
  AdaptParams adapt;
  std::vector<std::string> creases{"auto"}, reconstructions{"bilinear", "bicubic"};
  int samples = 128, threads = 0;
  LightParams light;
};

struct NamedRoom {
  std::string name;
  std::vector<std::string> views;  // for each view, the text of the room with this view
};

RoomKind parse_kind(const std::string& name) {
  std::vector<std::string> known;
  for (const auto& [kind_name, kind] : room_kinds()) {
    if (kind_name == name) return kind;
    known.push_back(kind_name);
  }
  throw CLI::ValidationError(
      "--kind", fmt::format("found \"{}\", expected one of {}", name, fmt::join(known, ", ")));
}

NamedRoom make_random(RoomKind kind, const std::string& kind_name, std::uint64_t seed) {
  NamedRoom room;
  room.name =
      kind == RoomKind::blocks ? fmt::format("{}", seed) : fmt::format("{}-{}", kind_name, seed);
  const int views = kind == RoomKind::blocks ? 1 : ROOM_VIEWS;
  for (int view = 0; view < views; ++view)
    room.views.push_back(make_room_of_kind(kind, seed, view));
  return room;
}

std::vector<NamedRoom> make_rooms(const Options& o) {
  std::vector<NamedRoom> rooms;
  for (const auto& file : o.files)
    rooms.push_back({std::filesystem::path(file).stem().string(), {base::read_text(file)}});
  if (o.seeds.empty()) return rooms;
  const auto ends = base::split(o.seeds, '-');
  const auto first = base::parse_number<std::uint64_t>(ends.front()),
             last = base::parse_number<std::uint64_t>(ends.back());
  if (!first || !last || ends.size() > 2 || *last < *first)
    throw CLI::ValidationError("--seeds",
                               fmt::format("found \"{}\", expected FIRST-LAST", o.seeds));
  for (std::uint64_t seed = *first; seed <= *last; ++seed)
    rooms.push_back(make_random(parse_kind(o.kind), o.kind, seed));
  return rooms;
}

// How a room is solved and shown.
struct Way {
  int refine = 1;
  std::string creases, reconstruction;
  std::string write() const { return fmt::format("{} {} {}", refine, creases, reconstruction); }
};

struct Outcome {
  Way way;
  std::string refused;
  std::size_t patches = 0;
  double solve_s = 0;
  Deviation deviation;
  // size of the largest group of pixels that are wrong here, but right with bilinear interpolation
  int beyond = 0;
};

template <class P>
P choose(const base::Field<P>& field, const std::string& value) {
  P chosen{};
  const std::string expected = field.assign(chosen, value);
  if (!expected.empty())
    throw CLI::ValidationError("--" + field.name,
                               fmt::format("found \"{}\", expected {}", value, expected));
  return chosen;
}

ReconstructionParams make_reconstruction(const std::string& kind) {
  return choose(reconstruction_fields().front(), kind);
}

// A room, seen from one position.
struct View {
  std::string name;
  Room room;
  Reference reference;
};

class Comparison {
 public:
  explicit Comparison(const Options& o) : o_(o) {
    laboratory::parse_size(o.size, picture_);
    fmt::print(
        "# errors in %: of the mean radiosity (rmse, bias, noise), of each pixel (p99 and worst\n"
        "# within faces, p99 at their edges); group: most pixels together that are {:.0f} % off;\n"
        "# beyond: where bilinear is not\n"
        "{:>16} {:>6} {:>7} {:>14} {:>8} {:>8} {:>6} {:>6} {:>6} {:>7} {:>6} {:>6} {:>6} {:>6}\n",
        100 * OFF, "room", "refine", "creases", "reconstruction", "patches", "solve_s", "rmse",
        "bias", "p99", "worst", "edges", "group", "beyond", "noise");
  }

  void compare_room(const NamedRoom& named) {
    std::vector<View> views;
    for (const std::string& text : named.views) {
      View view{
          named.views.size() == 1 ? named.name : fmt::format("{}.{}", named.name, views.size()),
          read_room(text, named.name + ".room"),
          {}};
      TracerParams tracer;
      tracer.width = picture_.width;
      tracer.height = picture_.height;
      tracer.samples = o_.samples;
      tracer.threads = o_.threads;
      view.reference = find_reference(text, view.room, tracer, o_.cache);
      leave_out_edges(view.reference, view.room);
      save(view.reference.picture, view.reference, view.name + "-reference");
      views.push_back(std::move(view));
    }
    for (const int refine : o_.refine)
      for (const auto& creases : o_.creases) try_way(views, refine, creases);
  }

  void print_summary() const {
    fmt::print("\n# summary: median, nine of ten, and worst of the views that were not refused\n");
    fmt::print(
        "{:>6} {:>7} {:>14} {:>5} {:>7} {:>20} {:>17} {:>17} {:>18} {:>20} {:>18} {:>11} {:>11}\n",
        "refine", "creases", "reconstruction", "views", "refused", "solve_s", "rmse", "bias", "p99",
        "worst", "edges", "group>=12", "beyond>=12");
    for (const int refine : o_.refine)
      for (const auto& creases : o_.creases)
        for (const auto& kind : o_.reconstructions) print_summary({refine, creases, kind});
  }

 private:
  // Lights the room. If the mesh is adapted until an error is reached, this is the error with the
  // first of the reconstructions.
  LitRoom light_adapted(const Room& room, const LightParams& light) const {
    const auto shown = make_reconstruction(o_.reconstructions.front());
    AdaptedMesh adapted =
        o_.adapt.error > 0 ? adapt_mesh(room, light, shown, o_.adapt) : make_lit_mesh(room, light);
    const Solution solution = solve_adapted(room, adapted, light);
    LitRoom lit{std::move(adapted.mesh), {}};
    lit.vertices = solution.vertices;
    if (light.ambient) add_ambient(lit.mesh, solution.ambient, lit.vertices);
    return lit;
  }

  // Solves the room once for all views, or for each view if the mesh is adapted to the view.
  void try_way(const std::vector<View>& views, int refine, const std::string& creases) {
    Outcome outcome{{refine, creases, ""}, "", 0, 0, {}, 0};
    LitRoom lit;
    for (const View& view : views) {
      if (&view == &views.front() || o_.adapt.error > 0) solve(view.room, lit, outcome);
      show(view, lit, outcome);
    }
  }

  void solve(Room room, LitRoom& lit, Outcome& outcome) const {
    outcome.refused.clear();
    try {
      const auto begin = std::chrono::steady_clock::now();
      choose_creases(room, choose(creases_field(), outcome.way.creases));
      LightParams light = o_.light;
      light.mesh.refine = outcome.way.refine;
      lit = light_adapted(room, light);
      const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
      outcome.solve_s = took.count();
      outcome.patches = lit.mesh.patches.size();
    } catch (const BadInput& bad) {
      outcome.refused = bad.what();
    }
  }

  void show(const View& view, const LitRoom& lit, Outcome outcome) {
    const auto& [name, room, reference] = view;
    std::vector<bool> bilinear;
    if (outcome.refused.empty())
      bilinear = find_off(trace_picture(lit, {Reconstruction::bilinear, {}}, room.view, picture_),
                          reference);
    for (const auto& kind : o_.reconstructions) {
      outcome.way.reconstruction = kind;
      if (outcome.refused.empty()) {
        const Picture picture = trace_picture(lit, make_reconstruction(kind), room.view, picture_);
        outcome.deviation = compare(picture, reference);
        std::vector<bool> off = find_off(picture, reference);
        for (std::size_t i = 0; i < off.size(); ++i) off[i] = off[i] && !bilinear[i];
        outcome.beyond = count_largest_group(off, picture.width);
        save(picture, reference,
             fmt::format("{}-{}-{}-{}", name, outcome.way.refine, outcome.way.creases, kind));
      }
      print(name, outcome);
      outcomes_.push_back(outcome);
    }
  }

  static void print(const std::string& name, const Outcome& o) {
    fmt::print("{:>16} {:>6} {:>7} {:>14} ", name, o.way.refine, o.way.creases,
               o.way.reconstruction);
    const Deviation& d = o.deviation;
    if (!o.refused.empty())
      fmt::print("refused: {}\n", o.refused);
    else
      fmt::print(
          "{:>8} {:>8.2f} {:>6.2f} {:>6.2f} {:>6.2f} {:>7.2f} {:>6.1f} {:>6} {:>6} {:>6.2f}\n",
          o.patches, o.solve_s, 100 * d.rmse, 100 * d.bias, 100 * d.p99, 100 * d.worst,
          100 * d.edges, d.group, o.beyond, 100 * d.noise);
    std::fflush(stdout);
  }

  void print_summary(const Way& way) const {
    std::vector<Outcome> solved;
    std::size_t rooms = 0;
    for (const Outcome& o : outcomes_)
      if (o.way.write() == way.write()) {
        ++rooms;
        if (o.refused.empty()) solved.push_back(o);
      }
    fmt::print("{:>6} {:>7} {:>14} {:>5} {:>7} ", way.refine, way.creases, way.reconstruction,
               rooms, rooms - solved.size());
    if (solved.empty()) {
      fmt::print("\n");
      return;
    }
    const auto spread = [&](auto f) {
      std::vector<double> values;
      for (const Outcome& o : solved) values.push_back(f(o));
      std::ranges::sort(values, {}, [](double x) { return std::abs(x); });
      return fmt::format("{:.2f} {:.2f} {:.2f}", values[values.size() / 2],
                         values[values.size() * 9 / 10], values.back());
    };
    const auto groups = [&](auto f) {
      int count = 0, most = 0;
      for (const Outcome& o : solved) count += f(o) >= 12 ? 1 : 0, most = std::max(most, f(o));
      return fmt::format("{} ({})", count, most);
    };
    fmt::print("{:>20} {:>17} {:>17} {:>18} {:>20} {:>18} {:>11} {:>11}\n",
               spread([](const Outcome& o) { return o.solve_s; }),
               spread([](const Outcome& o) { return 100 * o.deviation.rmse; }),
               spread([](const Outcome& o) { return 100 * o.deviation.bias; }),
               spread([](const Outcome& o) { return 100 * o.deviation.p99; }),
               spread([](const Outcome& o) { return 100 * o.deviation.worst; }),
               spread([](const Outcome& o) { return 100 * o.deviation.edges; }),
               groups([](const Outcome& o) { return o.deviation.group; }),
               groups([](const Outcome& o) { return o.beyond; }));
  }

  // Saves the picture, with the exposure of the reference, and a picture of its deviation.
  void save(const Picture& picture, const Reference& reference, const std::string& name) const {
    if (o_.pictures.empty()) return;
    std::filesystem::create_directories(o_.pictures);
    const std::string path = (std::filesystem::path(o_.pictures) / name).string();
    save_exr(path + ".exr", picture);
    save_png(path + ".png", picture, fit(Display{}, reference.picture, reference.emits));
    if (&picture != &reference.picture)
      save_png(path + "-off.png", draw_deviation(picture, reference, 2 * OFF), {1, 1});
  }

  const Options& o_;
  PictureParams picture_;
  std::vector<Outcome> outcomes_;
};

void add_options(CLI::App& app, Options& o) {
  app.add_option("ROOMS", o.files, ".room files");
  app.add_option("--seeds", o.seeds, "random rooms, FIRST-LAST");
  app.add_option("--kind", o.kind,
                 "of random rooms: blocks, lamps, doors, legs, slits, corridor, spiral, windows, "
                 "screens or mirrors; of all but blocks there are three views")
      ->capture_default_str();
  laboratory::bind_options(app, {adaptive_field()}, o.adapt);
  app.add_option("--refine", o.refine, "factors of the divisions")
      ->delimiter(',')
      ->capture_default_str();
  app.add_option("--creases", o.creases, "of file, auto, none")
      ->delimiter(',')
      ->capture_default_str();
  app.add_option("--reconstruction", o.reconstructions, "of bilinear, bicubic, flat")
      ->delimiter(',')
      ->capture_default_str();
  app.add_option("--size", o.size, "WxH in pixels")->capture_default_str();
  app.add_option("--paths", o.samples, "paths of a pixel")->capture_default_str();
  app.add_option("--threads", o.threads, "of the path tracer; 0: all");
  app.add_option("--keep", o.cache, "folder that references are kept in");
  app.add_option("--pictures", o.pictures,
                 "folder for pictures: .exr, .png, and -off.png, where what is too bright is red "
                 "and what is too dark blue, in full from 30 % on");
  laboratory::bind_options(app, solve_fields(), o.light.solve,
                           {{"max_shots", "shots"}, {"reflections", "mirrors"}});
  laboratory::bind_options(app, {senders_field()}, o.light);
  app.add_flag("--ambient,!--no-ambient", o.light.ambient,
               "add an estimate of the unsent light [yes]");
}

}  // namespace
}  // namespace radiosity::reference

int main(int argc, char** argv) {
  namespace reference = radiosity::reference;
  CLI::App app("compare radiosity's pictures with a path tracer's");
  reference::Options options;
  reference::add_options(app, options);
  try {
    app.parse(argc, argv);
    const auto rooms = reference::make_rooms(options);
    reference::Comparison comparison(options);
    for (const auto& room : rooms) comparison.compare_room(room);
    comparison.print_summary();
  } catch (const CLI::ParseError& error) {
    return app.exit(error);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
