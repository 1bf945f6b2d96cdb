// Films of runs, decoded and compared with what the machine did.
#include "experiments/laboratory/film/film.hpp"

#include <fmt/format.h>

#include <numeric>

#include "experiments/laboratory/film/frame.hpp"
#include "simulator/observe/run_monitor.hpp"
#include "tests/laboratory/support/one_point.hpp"
#include "tests/laboratory/support/tlab.hpp"
#include "tests/laboratory/support/two_processors.hpp"
#include "tests/support/webp_frames.hpp"
#include "topologies/draw/load_drawing.hpp"
#include "topologies/make/generators.hpp"

namespace laboratory {
namespace {

using Pixel = std::vector<int>;

Pixel colour_of(double share) {
  Pixel pixel;
  for (const double part : topologies::eval_load_colour(share))
    pixel.push_back(static_cast<int>(std::lround(255 * part)));
  return pixel;
}

void expect_near(const Pixel& found, const Pixel& expected, const std::string& what) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(found[i], expected[i], 2) << what << ", colour " << i;
}

// The pixel at a place inside a processor's circle that no letter covers.
Pixel pixel_of_processor(const test::WebpFrame& frame, const MachineDrawing& drawing, int id) {
  const auto& place = drawing.nodes().at(static_cast<std::size_t>(id)).place;
  return frame.pixel(place.x, place.y + 0.75 * drawing.radius());
}

// The pixel of a link near its middle, on the sender's half.
Pixel pixel_of_link(const test::WebpFrame& frame, const MachineDrawing& drawing, std::size_t i) {
  const auto& [p0, p1, p2, p3] = drawing.halves().at(i);
  return frame.pixel(0.3 * p2.x + 0.7 * p3.x, p3.y);
}

// A film of three frames, each for a third of the run. The busy shares in the frames are:
//   first processor   3/4  0    0
//   link              1/4  1/2  0
//   second processor  0    1/2  1
TEST(Film, ShowsSharesOfEachFramesTimeInTheColoursOfTheScale) {
  const TemporaryFolder folder;
  occam::Lab lab(occam::make_exact_model(), machine::Code::bare, {.links = machine::Links::direct});
  start_two_processors(lab);
  const auto file = (folder.path / "film.webp").string();
  const auto line = topologies::make_line(2);
  Film film({.picture = "", .network = file, .frames = 3}, line, 0);
  observe::Trace trace;
  observe::RunMonitor monitor;
  monitor.trace = &trace;
  monitor.observer = &film;
  observe::run(lab.machine, monitor);
  EXPECT_NEAR(monitor.ended.value, 1, 1e-4);
  film.save("two processors", trace);

  const MachineDrawing drawing(lab.machine, line, {});
  const auto frames = test::decode_webp(read_file(file));
  ASSERT_EQ(frames.size(), 3u);
  const double shares[3][3] = {{0.75, 0.25, 0}, {0, 0.5, 0.5}, {0, 0, 1}};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(frames[i].width, drawing.width());
    EXPECT_EQ(frames[i].height, drawing.height());
    const auto [one, link, other] = shares[i];
    const auto where = [&](const char* what) { return fmt::format("frame {}, {}", i, what); };
    expect_near(pixel_of_processor(frames[i], drawing, 0), colour_of(one), where("first"));
    expect_near(pixel_of_processor(frames[i], drawing, 1), colour_of(other), where("second"));
    if (link > 0) expect_near(pixel_of_link(frames[i], drawing, 0), colour_of(link), where("link"));
    EXPECT_NE(pixel_of_link(frames[i], drawing, 1), colour_of(0.25)) << "nothing came back";
  }
  EXPECT_NE(pixel_of_link(frames[1], drawing, 0), pixel_of_link(frames[1], drawing, 1));
  EXPECT_NE(pixel_of_link(frames[1], drawing, 0), pixel_of_link(frames[2], drawing, 0));
}

TEST(Film, TimesAreSaidInTheUnitOfTheWhole) {
  EXPECT_EQ(format_time(0.25, 1), "0.25 s");
  EXPECT_EQ(format_time(0.25, 40), "0.2 s");
  EXPECT_EQ(format_time(12, 3000), "12 s");
  EXPECT_EQ(format_time(0.00125, 0.02), "1.2 ms");
  EXPECT_EQ(format_time(0, 5e-6), "0.00 µs");
}

TEST(ExperimentsFilm, FilmsHaveTheirLengthAndTheResultsAreTheSame) {
  const TemporaryFolder folder;
  ASSERT_EQ(tlab(folder.path, one_point({"-o", "plain"})).exit_code, 0);
  const auto film = [&](const char* name) {
    const auto done =
        tlab(folder.path, one_point({"-o", name, "--animate", fmt::format("picture={}.webp", name),
                                     "--animate", "network", "--frames", "12"}));
    ASSERT_EQ(done.exit_code, 0) << done.err;
  };
  film("r");
  film("again");
  const auto image = folder.path / "r/image-spheres-20.png";
  for (const char* file : {"results.csv", "results.schema.json", "image-spheres-20.png"})
    EXPECT_EQ(read_file(folder.path / "plain" / file), read_file(folder.path / "r" / file)) << file;
  for (const auto& [file, again] :
       {std::pair("r.webp", "again.webp"), std::pair("r-network.webp", "again-network.webp")}) {
    const auto bytes = read_file(folder.path / file);
    EXPECT_EQ(bytes, read_file(folder.path / again)) << file;
    const auto frames = test::decode_webp(bytes);
    ASSERT_EQ(frames.size(), 12u) << file;
    EXPECT_EQ(frames[0].to_ms, 833);
    EXPECT_EQ(frames[11].from_ms, 9166);
    EXPECT_EQ(frames[11].to_ms, 12000);
  }
  const auto picture = renderer::load_png(image.string());
  const auto place = place_picture(16, 12);
  const auto frames = test::decode_webp(read_file(folder.path / "r.webp"));
  EXPECT_EQ(place.factor, 30);
  EXPECT_EQ(frames[0].width, place.width);
  EXPECT_EQ(frames[0].height, place.height);
  std::size_t final = 0;
  for (int y = 0; y < 12; ++y)
    for (int x = 0; x < 16; ++x) {
      const auto* rgb = picture.rgb8.data() + 3 * (16 * y + x);
      for (const double corner : {0.0, 0.99}) {
        const double at_x = place.x + place.factor * (x + corner);
        const double at_y = place.y + place.factor * (y + corner);
        EXPECT_EQ(frames[11].pixel(at_x, at_y), Pixel(rgb, rgb + 3)) << x << " " << y;
        EXPECT_EQ(frames[0].pixel(at_x, at_y), Pixel(3, 0)) << "nothing is shown at first";
      }
      final += frames[6].pixel(place.x + place.factor * x, place.y + place.factor * y) ==
               Pixel(rgb, rgb + 3);
    }
  EXPECT_GT(final, 0u) << "half way";
  EXPECT_LT(final, 12u * 16u) << "half way";
}

TEST(ExperimentsFilm, OneImageAFrame) {
  const TemporaryFolder folder;
  const auto done =
      tlab(folder.path,
           one_point({"-o", "r", "--animate", "network=f.png", "--frames", "3", "--from", "0.1"}));
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_TRUE(contains(done.out, "  film     f-0001.png to f-0003.png\n")) << done.out;
  EXPECT_EQ(folder.names(),
            (std::vector<std::string>{"f-0001.png", "f-0002.png", "f-0003.png", "r"}));
}

TEST(ExperimentsFilm, AFilmDoesNotBeginAfterTheRun) {
  const TemporaryFolder folder;
  for (const char* film : {"picture=f.webp", "network=f.webp"}) {
    const auto done = tlab(folder.path, one_point({"--animate", film, "--from", "1e12"}));
    EXPECT_EQ(done.exit_code, 2);
    EXPECT_TRUE(contains(done.err,
                         "--from: found 1000000000000, expected a time before the run's "
                         "end at 0."))
        << done.err;
    EXPECT_FALSE(std::filesystem::exists(folder.path / "f.webp"));
  }
}

TEST(Film, AFrameOfALargeNetworkIsNotLarge) {
  for (const auto& topology :
       {topologies::make_topology("tree:4096"), topologies::make_line(3000)}) {
    occam::Lab lab(occam::make_exact_model(), machine::Code::bare,
                   {.links = machine::Links::direct});
    for (int i = 0; i < topology.processors; ++i)
      lab.machine.add_processor(fmt::format("worker{}", i), 1 << 10);
    const MachineDrawing drawing(lab.machine, topology, {});
    EXPECT_LT(std::max(drawing.width(), drawing.height()), 2700);
  }
}

TEST(Film, ProcessorsAreCalledByTheirNumbers) {
  occam::Lab lab(occam::make_exact_model(), machine::Code::bare, {.links = machine::Links::direct});
  for (const char* name : {"worker12", "root", "node2.1"}) lab.machine.add_processor(name, 1 << 10);
  const MachineDrawing drawing(lab.machine, topologies::make_line(3), {});
  std::vector<std::string> labels;
  for (const auto& node : drawing.nodes()) labels.push_back(node.label);
  EXPECT_EQ(labels, (std::vector<std::string>{"12", "root", "node2.1"}));
}

// A host processor is linked to the root of the network, and another processor to the host.
TEST(Film, WhatHangsOnTheRootIsInRowsAboveTheNetwork) {
  occam::Lab lab(occam::make_exact_model(), machine::Code::bare, {.links = machine::Links::direct});
  auto& root = lab.cpu();
  lab.neighbour(root);
  auto& host = lab.neighbour(root);
  lab.neighbour(host);
  const MachineDrawing drawing(lab.machine, topologies::make_line(2), {});
  const auto place = [&](std::size_t id) { return drawing.nodes().at(id).place; };
  for (const std::size_t id : {2u, 3u}) {
    EXPECT_TRUE(drawing.nodes()[id].is_box);
    EXPECT_DOUBLE_EQ(place(id).x, place(0).x);
  }
  EXPECT_LT(place(2).y, place(0).y - 2 * drawing.radius());
  EXPECT_NEAR(place(2).y - place(3).y, place(0).y - place(2).y, 1e-9);
}

// The film ends between two tick marks, so there is none at the right end of the axis.
TEST(Film, TicksEndWithTheFilm) {
  constexpr int WIDTH = 600, HEIGHT = 100, BELOW_THE_BAR = HEIGHT - 23;
  Canvas canvas(WIDTH, HEIGHT);
  canvas.fill({0, 0, WIDTH, HEIGHT}, WHITE);
  draw_time_scale(canvas, {0, 0.95}, {0, 0.1});
  const auto bitmap = canvas.bitmap();
  const auto is_marked = [&](int x) {
    return bitmap.rgb8.at(static_cast<std::size_t>(3 * (WIDTH * BELOW_THE_BAR + x))) < 255;
  };
  EXPECT_TRUE(is_marked(FRAME_MARGIN)) << "the tick mark at 0 s";
  EXPECT_FALSE(is_marked(WIDTH - FRAME_MARGIN)) << "the film's end";
}

TEST(Canvas, AnOutlineHasItsColourAndItsWidth) {
  const Colour red{1, 0, 0};
  Canvas canvas(20, 20);
  canvas.fill({0, 0, 20, 20}, WHITE);
  canvas.outline({5, 5, 10, 10}, red, 4);
  const auto bitmap = canvas.bitmap();
  const auto pixel = [&](int x, int y) {
    const auto* rgb = bitmap.rgb8.data() + 3 * (20 * y + x);
    return Pixel(rgb, rgb + 3);
  };
  for (const int x : {3, 4, 5, 6}) EXPECT_EQ(pixel(x, 10), (Pixel{255, 0, 0})) << x;
  for (const int x : {2, 7}) EXPECT_EQ(pixel(x, 10), (Pixel{255, 255, 255})) << x;
}

// Films of runs that are ended early, fail or deadlock.
TEST(ExperimentsFilm, ARunThatDoesNotEndHasItsFilmSoFar) {
  const std::vector<std::pair<int, std::vector<std::string>>> cases{
      {0, {"--until", "0.2"}},
      {3, {"--set", "machine.database_memory_bytes=146432"}},
      {3, {"--set", "fault=[{at_s=0.3,link=[0,1]}]"}}};
  for (const auto& [code, more] : cases) {
    const TemporaryFolder folder;
    std::vector<std::string> all{
        "-o", "r", "--animate", "picture=p.webp", "--animate", "network=n.webp", "--frames", "4"};
    all.insert(all.end(), more.begin(), more.end());
    const auto done = tlab(folder.path, one_point(all));
    EXPECT_EQ(done.exit_code, code) << done.err;
    for (const char* file : {"p.webp", "n.webp"}) {
      ASSERT_TRUE(std::filesystem::exists(folder.path / file)) << more[1] << file;
      EXPECT_EQ(test::decode_webp(read_file(folder.path / file)).size(), 4u) << more[1] << file;
    }
  }
}

TEST(ExperimentsFilm, MistakesAreNamedBeforeAnythingRuns) {
  const TemporaryFolder folder;
  const auto told = [&](const std::vector<std::string>& more) {
    const auto done = tlab(folder.path, one_point(more));
    EXPECT_EQ(done.exit_code, 2) << done.err;
    return done.err;
  };
  const auto expect = [&](const std::vector<std::string>& more, const std::string& part) {
    const auto err = told(more);
    EXPECT_TRUE(contains(err, part)) << err;
  };
  expect({"--animate", "film"}, "found film, expected picture, network");
  expect({"--animate", "network="}, "found network=, expected");
  expect({"--animate", "network=n.gif"}, "found n.gif, expected a name that ends in .webp or .png");
  expect({"--animate", "network=a.webp", "--animate", "network=b.webp"}, "found network twice");
  expect({"--animate", "network=a.webp", "--animate", "picture=a.webp"},
         "expected a file that no other option uses");
  expect({"--animate", "network=a.webp", "--frames", "1"}, "--frames");
  expect({"--frames", "10"}, "--animate");
  expect({"--animate", "network=a.webp", "--set", "sweep.workers=[1, 2]"}, "has 2 points");
  expect({"--animate", "network=no/such/folder/a.webp"}, "no/such/folder/a.webp");
  expect({"-o", "r", "--animate", "network=r/a.webp"}, "outside the results folder");
  expect({"--animate", "network=a.webp", "--set", "network.topology=\"line\"", "--set",
          "sweep.workers=[16385]"},
         "found network with 16385 processors (line:16385), expected at most 16384");
  expect({"-o", "r", "--animate", "picture=a.webp", "--frames", "1000", "--set", "image.width=350",
          "--set", "image.height=250"},
         "found 1000 frames of 350 x 250 pixels, expected at most 952");
  expect(
      {"-o", "r", "--animate", "picture=a.webp", "--frames", "2", "--set", "image.width=16336",
       "--set", "image.height=1"},
      "found a picture of 16336 x 1 pixels, expected at most 16223 pixels on each side in .webp");
  EXPECT_EQ(folder.names(), std::vector<std::string>{});
}

TEST(ExperimentsFilm, ProgramsWithoutAPictureOrANetworkAreNamed) {
  const TemporaryFolder folder;
  const auto told = [&](const char* text, const char* kind) {
    write_file(folder.path / "e.toml", text);
    const auto done = tlab(
        folder.path, {"run", "e.toml", "-o", "r", "--animate", fmt::format("{}=a.webp", kind)});
    EXPECT_EQ(done.exit_code, 2) << done.err;
    return done.err;
  };
  EXPECT_TRUE(contains(told("[program]\nname = \"message\"\n", "network"), "message has none"));
  EXPECT_TRUE(contains(told("[program]\nname = \"message\"\n", "picture"), "message shows none"));
  EXPECT_EQ(folder.names(), std::vector<std::string>{"e.toml"});
}

}  // namespace
}  // namespace laboratory
