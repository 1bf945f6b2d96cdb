// Radiosity on a simulated machine: its solution must be the same on any machine. Also tests its
// times.
#include "base/errors.hpp"
#include "simulator/parallel_radiosity/radiosity.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <map>
#include <random>

#include "simulator/parallel_radiosity/messages.hpp"
#include "tests/renderer/radiosity/support.hpp"
#include "tests/simulator/network/router_support.hpp"
#include "topologies/make/generators.hpp"

namespace parallel_radiosity {
namespace {

using radiosity::Mesh;
using test::isolated;
using test::run_isolated;

Mesh make_room(std::uint64_t seed, int n) {
  renderer::test::Random random(seed);
  radiosity::Room room = radiosity::test::make_furnished(random, 2, n);
  room.materials = {{"wall", {0.7, 0.5, 0.3}, {}}, {"lamp", {}, {9, 8, 7}}};
  radiosity::test::add_quad(room, 1, {1, 1, 1.8}, {0, 0.4, 0}, {0.4, 0, 0}, 2, 2);
  return make_mesh(room, {});
}

Params make_params(int shots) {
  Params params;
  params.solve.shots = shots;
  params.solve.tolerance = 0;
  return params;
}

Result run(const std::string& topology, const Mesh& mesh, const Params& params,
           const std::string& model = "t805-25") {
  return run_radiosity({machine::load_model(model), topologies::make_topology(topology)}, mesh,
                       params);
}

bool are_equal(const Frame& frame, const radiosity::Solution& oracle) {
  return frame.vertices == oracle.vertices && frame.ambient == oracle.ambient &&
         frame.unshot == oracle.unshot && frame.shots == oracle.shots;
}

TEST(Amp, SolutionEqualsTheSequentialOneBitForBit) {
  const std::uint64_t seed = 20261122;
  std::mt19937_64 random(seed);
  const network::Method methods[] = {network::Method::green, network::Method::chalmers,
                                     network::Method::acyclic};
  for (const char* topology : {"line:1", "line:2", "ring:5", "tree:7", "mesh:3x3", "torus:3x3",
                               "amp:12", "hypercube:4", "star:5"})
    for (const auto how : {Distribution::blocks, Distribution::tiles, Distribution::work})
      for (const bool exchange : {false, true}) {
        const auto room = random() % 3;
        const Mesh mesh = make_room(room, 2 + int(random() % 3));
        Params params = make_params(1 + int(random() % 12));
        params.distribution = how;
        params.exchange = exchange;
        params.method = methods[random() % 3];
        params.show_every = int(random() % 4);
        SCOPED_TRACE(fmt::format("{}, distribution {}, exchange {}, room {}, shots {}, seed {}",
                                 topology, int(how), exchange, room, params.solve.shots, seed));
        run_isolated([&] {
          const auto oracle = solve(mesh, params.solve);
          const auto result = run(topology, mesh, params);
          EXPECT_TRUE(are_equal(result.frames.back(), oracle));
        });
      }
}

TEST(Amp, EndsWhereTheSequentialOneDoes) {
  const Mesh mesh = make_room(1, 2);
  Params params = make_params(1000);
  params.solve.tolerance = 0.05;
  run_isolated([&] {
    const auto oracle = solve(mesh, params.solve);
    const auto result = run("mesh:2x3", mesh, params);
    EXPECT_TRUE(are_equal(result.frames.back(), oracle));
    EXPECT_GT(oracle.shots, 20);
    EXPECT_LT(oracle.shots, 1000);
  });
}

TEST(Amp, EveryFrameIsTheSequentialSolutionAfterItsShots) {
  const Mesh mesh = make_room(2, 3);
  Params params = make_params(11);
  params.show_every = 3;
  run_isolated([&] {
    const auto result = run("ring:4", mesh, params);
    std::vector<int> shots;
    double last = 0;
    for (const Frame& frame : result.frames) {
      auto until = params.solve;
      until.shots = frame.shots;
      EXPECT_TRUE(are_equal(frame, solve(mesh, until))) << frame.shots;
      EXPECT_GT(frame.at_s, last);
      last = frame.at_s;
      shots.push_back(frame.shots);
    }
    EXPECT_EQ(shots, (std::vector{3, 6, 9, 11}));
    EXPECT_EQ(last, result.total_s);
  });
}

// A single processor loses only the time that the root's decisions take. On several processors, all
// losses and the useful part must add up to the total time.
TEST(Amp, LossesAddUp) {
  const Mesh mesh = make_room(0, 4);
  for (const char* topology : {"line:1", "mesh:3x3"})
    for (const bool exchange : {false, true})
      run_isolated([&] {
        SCOPED_TRACE(fmt::format("{} {}", topology, exchange));
        Params params = make_params(10);
        params.exchange = exchange;
        const auto r = run(topology, mesh, params);
        const Loss& l = r.loss;
        const double sum = l.useful + l.repeated + l.unequal + l.messages;
        const bool alone = topology == std::string("line:1");
        double busy = 0;
        for (const auto& cpu : r.use.cpus) busy += cpu.busy_s;
        busy /= static_cast<double>(r.use.cpus.size()) * r.time_s;
        EXPECT_NEAR(sum, 1, 1e-12);
        if (alone) {
          EXPECT_GT(l.useful, 0.999);
        } else {
          EXPECT_LT(l.useful, 0.95);
        }
        EXPECT_EQ(l.repeated > 0.01, !exchange && !alone) << l.repeated;
        EXPECT_GT(busy, l.useful + l.repeated);
        EXPECT_LT(busy, 1 + 1e-9);
      });
}

// A single processor never waits, so the machine's time must be that of the kernels' cycles.
TEST(Amp, OneProcessorTakesItsKernelsTime) {
  const Mesh mesh = make_room(0, 3);
  const Params params = make_params(5);
  run_isolated([&] {
    const auto model = machine::load_model("t805-25");
    const auto oracle = solve(mesh, params.solve);
    const machine::OperationCosts costs(model, "radiosity", renderer::op_names());
    const auto r = run("line:1", mesh, params);
    const double kernels_s = double(costs(r.work.counts).value) / model.cpu.clock.value;
    using renderer::Op;
    EXPECT_EQ(r.work[Op::ray_intersected], oracle.work[Op::ray_intersected]);
    EXPECT_NEAR(r.time_s / kernels_s, 1, 1e-3);
  });
}

TEST(Amp, SharedGeometryGivesTheSameSolution) {
  const Mesh mesh = make_room(1, 2);
  for (const double percent : {100.0, 40.0})
    for (const char* topology : {"line:1", "ring:4", "amp:6"})
      run_isolated([&] {
        SCOPED_TRACE(fmt::format("{} {}", topology, percent));
        Params params = make_params(4);
        params.cache_percent = percent;
        const auto r = run(topology, mesh, params);
        EXPECT_TRUE(are_equal(r.frames.back(), solve(mesh, params.solve)));
        EXPECT_GT(r.data.accesses(), 1000u);
        if (percent < 100 && std::string(topology) != "line:1") {
          EXPECT_GT(r.data.requests, 0u);
        }
      });
}

// If all processors have another model, the times must be those of a machine of this model. If only
// some have it, the faster processors must wait.
TEST(Amp, ProcessorsOfOtherModels) {
  const Mesh mesh = make_room(1, 3);
  for (const double cache_percent : {0., 30.}) {
    Params params = make_params(3);
    params.cache_percent = cache_percent;
    const auto slow = std::make_shared<const machine::Model>(machine::load_model("t800-20"));
    const auto run_with = [&](const programs::OtherModels& others,
                              const std::string& model = "t805-25") {
      return run_radiosity({.model = machine::load_model(model),
                            .topology = topologies::make_topology("ring:5"),
                            .engine = {.links = machine::Links::direct},
                            .others = others},
                           mesh, params);
    };
    programs::OtherModels all;
    for (int id = 0; id < 5; ++id) all.emplace(id, slow);
    const auto quick_run = run_with({});
    const auto slow_run = run_with({}, "t800-20");
    EXPECT_EQ(run_with(all).time_s, slow_run.time_s);
    // At least if the slow processor is the one with the most work, the others must wait for it.
    double latest = 0, most_unequal = 0;
    for (int id = 0; id < 5; ++id) {
      const auto mixed_run = run_with({{id, slow}});
      EXPECT_TRUE(are_equal(mixed_run.frames.back(), solve(mesh, params.solve)));
      EXPECT_LE(mixed_run.time_s, 1.02 * slow_run.time_s);
      latest = std::max(latest, mixed_run.time_s);
      most_unequal = std::max(most_unequal, mixed_run.loss.unequal);
    }
    EXPECT_GT(latest, 1.05 * quick_run.time_s);
    if (cache_percent == 0) {
      EXPECT_GT(most_unequal, quick_run.loss.unequal);
    }
  }
}

TEST(Amp, RefusesWhatCannotBe) {
  const Mesh mesh = make_room(0, 1);
  const auto refusal = [&](const std::string& topology, const Params& params) {
    return isolated([&]() -> std::string {
      try {
        run(topology, mesh, params);
        return "ran";
      } catch (const base::BadInput& error) {
        return error.what();
      }
    });
  };
  EXPECT_NE(refusal("line:200", make_params(1)).find("found 200 processors, expected at most"),
            std::string::npos);
  Params params = make_params(1);
  params.cache_percent = 0.01;
  EXPECT_NE(refusal("line:2", params).find("(0.01 % of a geometry"), std::string::npos);
}

// To measure the host time of a kernel, the kernel runs again on a copy of the state. The solution
// must not change.
TEST(Amp, TimedKernelsComputeTheSame) {
  const Mesh mesh = make_room(1, 2);
  for (const double cache_percent : {0.0, 50.0})
    run_isolated([&] {
      Params params = make_params(6);
      params.cache_percent = cache_percent;
      params.show_every = 2;
      int drawn = 0;
      params.draw = [&](const Frame&) { ++drawn; };
      const auto result = run_radiosity({.model = machine::load_model("t805-25"),
                                         .topology = topologies::make_topology("line:3"),
                                         .cycles_per_host_s = 1e9},
                                        mesh, params);
      EXPECT_TRUE(are_equal(result.frames.back(), solve(mesh, params.solve)));
      std::map<std::string, std::uint64_t> calls;
      for (const auto& kernel : result.kernels) calls[kernel.name] = kernel.calls;
      const std::map<std::string, std::uint64_t> expected{
          {"choose", 21}, {"receive", 18}, {"settle", 18}, {"draw", result.frames.size()}};
      EXPECT_EQ(calls, expected);
      EXPECT_GT(drawn, int(result.frames.size()));
    });
}

TEST(Amp, PatchesThatDoNotFitTheMemoryAreOutOfMemory) {
  const Mesh mesh = make_room(0, 60);
  EXPECT_EQ(isolated([&]() -> std::string {
              try {
                run("line:1", mesh, make_params(1));
                return "ran";
              } catch (const machine::OutOfMemory& error) {
                return "out of memory";
              }
            }),
            "out of memory");
}

// If the set-up of a copy takes more cycles, the time must grow by as many cycles for each colour
// that enters or leaves a message. (The number of the routers' own copies does not depend on the
// length of borders.)
TEST(Amp, ColoursOfMessagesAreCopied) {
  constexpr int SHOTS = 3, MORE = 1000;
  const auto count_colours_of_borders = [](const Mesh& mesh) {
    auto shares = distribute(mesh, 2, Distribution::tiles);
    exchange_borders(shares, mesh.vertices.size());
    std::size_t sum = 0;
    for (const Share& share : shares)
      for (const Border& border : share.out) {
        EXPECT_LE(border.vertices.size(), MessageBytes::MOST);
        sum += border.vertices.size();
      }
    return sum;
  };
  const auto count_cycles = [](const Mesh& mesh, int setup) {
    const auto cycles = isolated([&] {
      const auto model =
          machine::override_model("t805-25", {{"instruction.move_setup", double(setup)}}, "tests");
      const auto r =
          run_radiosity({model, topologies::make_topology("line:2")}, mesh, make_params(SHOTS));
      double busy_s = 0;
      for (const auto& cpu : r.use.cpus) busy_s += cpu.busy_s;
      return fmt::format("{}", busy_s * model.cpu.clock.value);
    });
    return std::stod(cycles);
  };
  const auto cycles_more = [&](const Mesh& mesh) {
    return count_cycles(mesh, 8 + MORE) - count_cycles(mesh, 8);
  };
  const Mesh coarse = make_room(0, 1), fine = make_room(0, 2);
  const auto few = count_colours_of_borders(coarse), many = count_colours_of_borders(fine);
  ASSERT_GT(many, few);
  EXPECT_NEAR((cycles_more(fine) - cycles_more(coarse)) /
                  (2.0 * SHOTS * MORE * static_cast<double>(many - few)),
              1, 0.01);
}

// A strip must be cut across, whatever its direction in space.
TEST(AmpDistribution, TilesAreCutAcrossTheLongerSide) {
  for (const int axis : {0, 1, 2}) {
    const radiosity::Vec axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const radiosity::Vec along = 8.0 * axes[axis], across = 2.0 * axes[(axis + 1) % 3];
    radiosity::Room room;
    room.materials = {{"wall", {0.7, 0.5, 0.3}, {}}};
    radiosity::test::add_quad(room, 0, {}, along, across, 8, 2);
    const Mesh mesh = make_mesh(room, {});
    const auto shares = distribute(mesh, 4, Distribution::tiles);
    for (std::size_t id = 0; id < 4; ++id) {
      ASSERT_EQ(shares[id].patches.size(), 4u);
      double least = 8, most = 0;
      for (const auto p : shares[id].patches) {
        least = std::min(least, mesh.patches[p].centre[axis]);
        most = std::max(most, mesh.patches[p].centre[axis]);
      }
      EXPECT_NEAR(most - least, 1, 1e-12) << "axis " << axis;
    }
  }
}

// Messages with corners are longer as well, but their buffers do not depend on the mesh. The
// comparison of two meshes therefore shows the memory that each patch needs.
TEST(Amp, LightAtTheCornersTakesFourColoursForEachPatch) {
  const auto eval_peak = [](const Mesh& mesh, radiosity::Sends sends) {
    return test::isolated_numbers([&] {
             Params params = make_params(2);
             params.solve.sends = sends;
             const auto use = run("line:1", mesh, params).use;
             return std::vector{static_cast<double>(use.cpus.at(0).memory_peak_bytes)};
           })
        .at(0);
  };
  const auto eval_more = [&](const Mesh& mesh) {
    return eval_peak(mesh, radiosity::Sends::corners) - eval_peak(mesh, radiosity::Sends::mean);
  };
  const Mesh small = make_room(1, 2), large = make_room(1, 4);
  const auto colours = 4 * (large.patches.size() - small.patches.size());
  EXPECT_EQ(eval_more(large) - eval_more(small),
            static_cast<double>(colours * get_bytes(machine::load_model("t805-25"), "colour")));
}

TEST(AmpDistribution, EveryPatchIsInOneShareAndEveryVertexIsFoundOnce) {
  const Mesh mesh = make_room(1, 4);
  for (const int processors : {1, 2, 7, 16, 64})
    for (const auto how : {Distribution::blocks, Distribution::tiles, Distribution::work}) {
      auto shares = distribute(mesh, processors, how);
      std::vector<int> patches(mesh.patches.size()), vertices(mesh.vertices.size());
      std::size_t most = 0, least = mesh.patches.size();
      for (const Share& share : shares) {
        for (const auto p : share.patches) ++patches[p];
        most = std::max(most, share.patches.size());
        least = std::min(least, share.patches.size());
      }
      EXPECT_EQ(patches, std::vector<int>(patches.size(), 1));
      if (how != Distribution::work) {
        EXPECT_LE(most - least, how == Distribution::blocks ? 1u : 8u);
      }
      exchange_borders(shares, vertices.size());
      for (std::size_t id = 0; id < shares.size(); ++id) {
        for (const auto v : shares[id].vertices) ++vertices[v];
        for (const Border& out : shares[id].out) {
          const auto& theirs = shares[static_cast<std::size_t>(out.other)].in;
          const auto in = std::ranges::find(theirs, static_cast<int>(id), &Border::other);
          ASSERT_NE(in, theirs.end());
          EXPECT_EQ(in->vertices, out.vertices);
        }
      }
      EXPECT_EQ(vertices, std::vector<int>(vertices.size(), 1));
    }
}

// A shot that carries the light of the patch's corners needs three colours more than a shot that
// carries the patch's mean light.
TEST(AmpMessages, AreAsLongAsWhatTheySay) {
  const auto model = machine::load_model("t805-25");
  const auto colour = get_bytes(model, "colour");
  for (const auto& [sends, colours] :
       {std::pair(radiosity::Sends::mean, 0), {radiosity::Sends::corners, 3}}) {
    const MessageBytes bytes(model, sends);
    for (const std::size_t n : {0u, 1u, 64u}) {
      const std::vector<radiosity::Rgb> values(n);
      EXPECT_EQ(bytes.of(Given{0, values}), 8 + n * colour);
      EXPECT_EQ(bytes.of(Displayed{0, values}), 8 + n * colour);
      EXPECT_GE(bytes.longest(), bytes.of(Given{0, values}));
    }
    const auto more = static_cast<std::uint64_t>(colours) * colour;
    EXPECT_EQ(bytes.of(Candidate{}), get_bytes(model, "radiosity_candidate") + more);
    EXPECT_EQ(bytes.of(radiosity::Shot{}), get_bytes(model, "radiosity_shot") + more);
    EXPECT_EQ(bytes.of(Stop{}), 8u);
  }
}

TEST(AmpMessages, TheBrightestDoesNotDependOnTheOrder) {
  std::mt19937_64 random(7);
  for (int round = 0; round < 200; ++round) {
    std::vector<Candidate> all(2 + random() % 6);
    for (auto& candidate : all) {
      candidate.unshot = {std::int64_t(random() % 1000), 1, 2};
      if (random() % 4 != 0)
        candidate.shot = radiosity::Shot{std::uint32_t(random() % 100), {}, double(random() % 3)};
    }
    const auto sum = [&] {
      Candidate best;
      for (const auto& candidate : all) best += candidate;
      return std::tuple(best.shot ? best.shot->patch : 1000u, best.shot ? best.shot->power : -1,
                        best.unshot.r);
    };
    const auto first = sum();
    std::ranges::shuffle(all, random);
    EXPECT_EQ(sum(), first);
  }
}

}  // namespace
}  // namespace parallel_radiosity
