// Complete runs of IIRRA on random machines. Compares the image with the sequential renderer's, and
// the work with a simple count of the work that is necessary.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "simulator/ray_tracing/data.hpp"
#include "tests/simulator/iirra/iirra_support.hpp"
#include "tests/simulator/iirra/random_orders.hpp"
#include "tests/support/places.hpp"

namespace iirra {
namespace {

// --- random cases -------------------------------------------------------------------------------

struct Case {
  std::string topology, scene;
  Params params;
  std::optional<ray_tracing::SharedParams> data;
  std::uint64_t seed = 1;
  machine::EngineParams engine = {};
  std::optional<double> cycles_per_host_s = {};
};

Case make_case(std::uint64_t seed) {
  Random random(seed);
  Case made;
  made.seed = seed;
  made.topology = random_topology(random);
  const char* const scenes[] = {"own glass", "spheres", "glass.nff", "mirrors.nff"};
  made.scene = scenes[below(random, 4)];
  auto& params = made.params;
  // If the scene is distributed and too large for the cache, runs are slow. The images are smaller
  // in these cases.
  const bool is_shared = random() % 2;
  params.image.width = 8 + below(random, is_shared ? 9 : 33);
  params.image.height = 8 + below(random, is_shared ? 9 : 33);
  params.image.limits.depth = 1 + below(random, is_shared ? 2 : 4);
  if (random() % 4 == 0)
    params.image.area = {1 + below(random, 3), below(random, 4), 4, 3 + below(random, 3)};
  const auto area = get_area(params.image);
  const int least = std::min(area.width, area.height);
  do params.max_cell = 2 << random() % 4;
  while (params.max_cell > least);
  params.order = static_cast<CellOrder>(random() % 5);
  params.start = static_cast<Start>(random() % 3);
  params.balance = static_cast<BalanceMethod>(random() % 7);
  params.reserve = 1 + below(random, 3);
  params.is_far = params.balance == BalanceMethod::green || random() % 2;
  params.is_polled = random() % 2;
  params.seed = seed;
  constexpr network::Method METHODS[] = {network::Method::green, network::Method::chalmers,
                                         network::Method::acyclic};
  params.method = METHODS[random() % 3];
  if (random() % 2 == 0) params.stages = {random_limits(random, area), random_limits(random, area)};
  params.script = random_script(random, area);
  if (is_shared) made.data = random_data(random, params.method);
  return made;
}

std::string describe(const Case& c) {
  const auto& p = c.params;
  return fmt::format(
      "{}, {}, {} x {} pixels, cells {}, order {}, start {}, balance {}, reserve {}, "
      "far {}, polled {}, method {}, data {}, orders {}",
      c.topology, c.scene, p.image.width, p.image.height, p.max_cell, int(p.order), int(p.start),
      int(p.balance), p.reserve, p.is_far, p.is_polled, int(p.method),
      c.data ? fmt::format("{} {} %", int(c.data->scheme), c.data->cache_percent) : "whole",
      p.script.size());
}

renderer::Scene load(const std::string& scene) {
  if (scene == "own glass") return make_glass_scene();
  if (scene == "spheres") return renderer::make_spheres(40);
  return renderer::load_scene(::test::in_sources("experiments/scenes/" + scene));
}

// Makes the topology of a case. In every third case, about half of the links that can be doubled
// are doubled.
topologies::Topology make_board(const Case& c) {
  auto board = topologies::make_topology(c.topology);
  if (c.seed % 3 != 0) return board;
  Random random(c.seed);
  for (const auto& [a, b] : topologies::Topology(board).links) {
    const int here = free_port(board, a.processor), there = free_port(board, b.processor);
    if (random() % 2 && here >= 0 && there >= 0)
      board.links.push_back({{a.processor, here}, {b.processor, there}});
  }
  sort_links(board);
  check(board);
  return board;
}

// In every fourth case, makes some processors slower.
programs::OtherModels make_others(const Case& c, int processors) {
  programs::OtherModels others;
  if (c.seed % 4 != 0) return others;
  const auto slow = std::make_shared<const machine::Model>(machine::load_model("t800-20"));
  Random random(c.seed);
  for (int id = 0; id < processors; ++id)
    if (random() % 3 == 0) others.emplace(id, slow);
  return others;
}

Result run_case(const Case& c) {
  const auto scene = load(c.scene);
  auto setup = make_setup(make_board(c));
  setup.others = make_others(c, setup.topology.processors);
  setup.engine = c.engine;
  setup.cycles_per_host_s = c.cycles_per_host_s;
  auto params = c.params;
  if (c.data) {
    check_data(setup.model, ray_tracing::size_of(scene), *c.data);
    params.data = make_data_params(setup.model, ray_tracing::size_of(scene), *c.data);
  }
  return run_iirra(setup, scene, params);
}

// --- necessary work -----------------------------------------------------------------------------

// The samples that a worker needs if it keeps all its cells.
struct Needed {
  std::set<std::pair<int, int>> points;
  std::uint64_t asked = 0;    // number of samples over all levels, including repeated ones
  std::uint64_t divided = 0;  // number of divided cells
};

void need(Needed& needed, SampledCell cell, const renderer::Area& area) {
  const int right = area.x + area.width, down = area.y + area.height;
  if (cell.x >= right || cell.y >= down) return;
  while (cell.level < last_level(cell))
    for (const Point& p : points_of_level(cell, ++cell.level)) {
      needed.points.insert({p.x, p.y});
      ++needed.asked;
    }
  if (cell.side == 2) return;
  ++needed.divided;
  for (const auto& daughter : divide(cell)) need(needed, daughter, area);
}

Needed need_all(const Params& params) {
  Needed needed;
  const auto area = get_area(params.image);
  for (const auto& cell : make_cells(area, params.max_cell)) need(needed, cell, area);
  return needed;
}

std::uint64_t count_outside(const Needed& needed, const renderer::Area& area) {
  return static_cast<std::uint64_t>(std::ranges::count_if(needed.points, [&](const auto& p) {
    return p.first >= area.x + area.width || p.second >= area.y + area.height;
  }));
}

// If no cells move between workers, each worker must compute the samples of its own cells once.
void expect_exact_counts(const Case& c, const Result& result) {
  const auto area = get_area(c.params.image);
  const auto cells = make_cells(area, c.params.max_cell);
  const int columns = (area.width + c.params.max_cell - 1) / c.params.max_cell;
  const auto worker_of =
      assign(c.params.start, columns, static_cast<int>(cells.size()) / columns, result.workers);
  std::vector<Needed> of_worker(static_cast<std::size_t>(result.workers));
  for (std::size_t i = 0; i < cells.size(); ++i)
    need(of_worker.at(static_cast<std::size_t>(worker_of[i])), cells[i], area);
  std::uint64_t samples = 0, outside = 0, asked = 0;
  for (const auto& needed : of_worker) {
    samples += needed.points.size();
    outside += count_outside(needed, area);
    asked += needed.asked;
  }
  EXPECT_EQ(result.counts.samples, samples);
  EXPECT_EQ(result.counts.samples_outside, outside);
  EXPECT_EQ(result.counts.samples + result.counts.samples_shared, asked);
}

void expect_counts(const Case& c, const Result& result) {
  const auto& counts = result.counts;
  const auto area = get_area(c.params.image);
  const auto pixels = static_cast<std::uint64_t>(area.width * area.height);
  const auto needed = need_all(c.params);
  EXPECT_EQ(counts.cells_divided, needed.divided);
  EXPECT_GE(counts.samples_outside, count_outside(needed, area));
  EXPECT_GE(counts.samples - counts.samples_outside, pixels);
  const auto once = result.rays_image.total() + result.rays_outside.total();
  EXPECT_GE(result.rays.total(), once);
  const bool is_alone = result.workers == 1 && c.params.start != Start::subsampled;
  if (is_alone) {
    EXPECT_EQ(result.rays.total(), once);
  }
  if (is_alone || (c.params.balance == BalanceMethod::none && c.params.start != Start::subsampled))
    expect_exact_counts(c, result);
}

// --- a run --------------------------------------------------------------------------------------

void expect_pictures(const Case& c, const Result& result) {
  const auto expected = render(load(c.scene), c.params.image, 1);
  const auto area = get_area(c.params.image);
  for (int y = 0; y < c.params.image.height; ++y)
    for (int x = 0; x < c.params.image.width; ++x) {
      const auto pixel = static_cast<std::size_t>(y * c.params.image.width + x);
      const bool is_inside =
          x >= area.x && x < area.x + area.width && y >= area.y && y < area.y + area.height;
      const bool is_finished = result.finished[pixel];
      EXPECT_EQ(is_finished, is_inside && (is_finished || !result.is_aborted)) << x << " " << y;
      const auto sums = is_finished ? expected.samples.sums[pixel] : renderer::Samples::Sums{};
      EXPECT_EQ(result.samples.sums[pixel], sums) << x << " " << y;
    }
  if (result.is_aborted) return;
  EXPECT_EQ(result.samples, expected.samples);
  EXPECT_EQ(result.rgb8, make_rgb8(expected.samples));
  EXPECT_EQ(result.rays_image, expected.rays);
}

void expect_session(const Case& c, const Result& result) {
  EXPECT_EQ(result.orders_s.size(), c.params.script.size());
  std::set<std::string> names;
  double last_s = 0;
  for (const auto& key : result.key_images) {
    EXPECT_TRUE(names.insert(key.name).second) << key.name;
    EXPECT_FALSE(key.name.empty());
    EXPECT_GE(key.at.value, last_s);
    last_s = key.at.value;
    EXPECT_EQ(key.rgb8.size(), result.rgb8.size());
  }
  EXPECT_GE(result.interactive_s, 0);
  EXPECT_LE(result.interactive_s, result.time_s * (1 + 1e-12));
  EXPECT_LE(result.last_task_s, result.ended_s);
}

void expect_messages(const Case& c, const Result& result) {
  const auto& counts = result.counts;
  EXPECT_EQ(counts.samples, result.rays.primary);  // each sample has one primary ray
  EXPECT_EQ(counts.samples_outside, result.rays_outside.primary);
  if (c.params.balance == BalanceMethod::none) {
    EXPECT_EQ(counts.task_messages(), 0u);
  }
  if (c.params.balance == BalanceMethod::active) {
    EXPECT_EQ(counts.requests + counts.refusals, 0u);
  }
  EXPECT_GE(counts.tasks_moved, counts.moves);
  if (c.params.is_polled) {
    EXPECT_GE(counts.polls, counts.pictures);
    EXPECT_LE(counts.polls, counts.pictures + 1);
  } else {
    EXPECT_EQ(counts.polls, 0u);
  }
  for (const auto& cpu : result.use.cpus) {
    EXPECT_GE(cpu.busy_s, 0) << cpu.name;
    EXPECT_LE(cpu.busy_s, result.use.time_s * (1 + 1e-12)) << cpu.name;
  }
}

// Formats a run's times, counts and pictures so that any difference shows. Times get `digits`
// digits.
std::string tell(const Result& r, int digits = 17) {
  const auto& n = r.counts;
  std::string told =
      fmt::format("{:.{}g} {:.{}g} {:.{}g} {:.{}g};", r.time_s, digits, r.setup_s, digits,
                  r.interactive_s, digits, r.last_task_s, digits) +
      fmt::format("{} {} {} {} {} {} {} {} {} {} {} {} {} {} {} {};", n.samples, n.samples_outside,
                  n.samples_shared, n.cells_divided, n.requests, n.refusals, n.moves, n.tasks_moved,
                  n.bytes_moved, n.reports, n.polls, n.pictures, n.blocks, n.picture_bytes,
                  n.tasks_most, r.rays.total());
  for (const auto& cpu : r.use.cpus) told += fmt::format(" {:.{}g}", cpu.busy_s, digits);
  for (const auto& key : r.key_images) {
    told += fmt::format(";{} {:.{}g} ", key.name, key.at.value, digits);
    told.append(key.rgb8.begin(), key.rgb8.end());
  }
  for (const auto& note : r.notes) told += ";" + note;
  return told.append(r.rgb8.begin(), r.rgb8.end());
}

class IirraRuns : public testing::TestWithParam<std::uint64_t> {};

TEST_P(IirraRuns, EndWithTheImageAndCountAllOfIt) {
  const Case c = make_case(GetParam());
  SCOPED_TRACE(fmt::format("seed {}: {}", GetParam(), describe(c)));
  const auto run_it = [&] {
    return isolated(
        [&] {
          const auto result = run_case(c);
          EXPECT_EQ(result.end, machine::End::done);
          expect_pictures(c, result);
          if (!result.is_aborted) expect_counts(c, result);
          expect_session(c, result);
          expect_messages(c, result);
          return tell(result);
        },
        60);
  };
  EXPECT_TRUE(run_it() == run_it()) << "two runs differ";
}

INSTANTIATE_TEST_SUITE_P(Seeds, IirraRuns, testing::Range<std::uint64_t>(1, 25));

// Runs every balancing method with every initial distribution, because random cases may miss some.
TEST(IirraRun, EveryBalancingAndStartGivesTheImage) {
  for (int balance = 0; balance < 7; ++balance)
    for (int start = 0; start < 3; ++start) {
      Case c{"mesh:2x4", "own glass", small_params(), {}};
      c.params.balance = static_cast<BalanceMethod>(balance);
      c.params.start = static_cast<Start>(start);
      c.params.is_polled = start != 1;
      SCOPED_TRACE(describe(c));
      run_isolated([&] {
        const auto result = run_case(c);
        expect_pictures(c, result);
        expect_counts(c, result);
        expect_messages(c, result);
      });
    }
}

// With SimGrid's actors instead of fibers, results must be equal to the last bit. With links
// outside SimGrid, they may differ only by the rounding of summed times.
TEST(IirraRun, EveryEngineDoesTheSame) {
  if (test::IS_SANITIZED) GTEST_SKIP() << "the sanitizer does not know the stacks of actors";
  Case c{"torus:2x4", "own glass", small_params(), {}};
  c.params.balance = BalanceMethod::mixed;
  c.data = ray_tracing::SharedParams{};
  c.data->cache_percent = 60;
  const auto told = [&](machine::EngineParams engine, int digits) {
    c.engine = engine;
    return isolated([&] { return tell(run_case(c), digits); });
  };
  EXPECT_TRUE(told({}, 17) == told({.processes = machine::Processes::actors}, 17));
  EXPECT_TRUE(told({}, 12) == told({.links = machine::Links::direct}, 12));
}

// With host times as costs, times differ, but the image must not.
TEST(IirraRun, TimedKernelsGiveTheImage) {
  for (const bool is_shared : {false, true}) {
    Case c{"ring:5", "own glass", small_params(), {}};
    c.cycles_per_host_s = 1e9;
    if (is_shared) c.data.emplace().cache_percent = 100;
    run_isolated([&] {
      const auto result = run_case(c);
      expect_pictures(c, result);
      expect_counts(c, result);
      std::map<std::string, std::uint64_t> calls;
      for (const auto& kernel : result.kernels) calls[kernel.name] = kernel.calls;
      EXPECT_EQ(calls["ray"], result.rays.total());
      EXPECT_GT(calls["interpolation"], 0u);
      EXPECT_EQ(calls["display"], result.counts.blocks);
    });
  }
}

// The painting of a large cell is longer than a message and must be split into strips.
TEST(IirraRun, LargeCellsAreShownInStrips) {
  for (const bool is_polled : {true, false}) {
    Case c{"mesh:2x3", "own glass", small_params(), {}};
    c.params.image.width = 70;
    c.params.image.height = 66;
    c.params.image.limits.depth = 1;
    c.params.max_cell = 64;
    c.params.is_polled = is_polled;
    run_isolated([&] {
      const auto result = run_case(c);
      expect_pictures(c, result);
      expect_counts(c, result);
    });
  }
}

// A single worker must compute each sample once. Two workers both compute the samples on the border
// between them.
TEST(IirraRun, SamplesOnBordersAreSharedWithinAProcessor) {
  Case c{"line:3", "own glass", small_params(), {}};
  run_isolated([&] {
    const auto result = run_case(c);
    EXPECT_EQ(result.workers, 1);
    expect_counts(c, result);
    EXPECT_EQ(result.counts.samples - result.counts.samples_outside, 24u * 18u);
    EXPECT_GT(result.counts.samples_shared, 0u);
  });
  c.topology = "line:4";
  c.params.balance = BalanceMethod::none;
  run_isolated([&] {
    const auto result = run_case(c);
    expect_counts(c, result);
    EXPECT_GT(result.counts.samples - result.counts.samples_outside, 24u * 18u);
  });
}

}  // namespace
}  // namespace iirra
