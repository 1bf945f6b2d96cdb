// Runs every program with its defaults on a small network. Checks in experiment files test the
// measurements of programs.
#include "simulator/programs/programs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "base/errors.hpp"
#include "simulator/programs/network/traffic.hpp"
#include "simulator/shared_memory/data_manager.hpp"
#include "tests/simulator/programs/run_program.hpp"
#include "tests/support/files.hpp"
#include "tests/support/lab.hpp"
#include "topologies/make/generators.hpp"

namespace programs {
namespace {

bool needs_a_file(const Program& program) {
  return std::ranges::any_of(program.parameters,
                             [](const auto& p) { return p.domain.is_required; });
}

TEST(Programs, HaveUniqueNamesAndDefaultsInRange) {
  std::set<std::string> names;
  for (const auto& program : all_programs()) {
    EXPECT_TRUE(names.insert(program.name).second) << program.name;
    std::set<std::string> columns{"topology", "workers", "processors"};
    for (const auto& p : program.parameters) {
      EXPECT_TRUE(columns.insert(p.name).second) << program.name << "." << p.name;
      const auto value = p.get(program.defaults);
      const bool is_unset = std::holds_alternative<std::monostate>(value);
      EXPECT_TRUE(is_unset || p.domain.is_required || p.domain.allows(value))
          << program.name << "." << p.name << ": " << p.domain.describe();
    }
  }
}

TEST(Programs, MeasureTheColumnsThatTheyDeclare) {
  const auto model = machine::load_model("t805-25");
  for (const auto& program : all_programs()) {
    const bool has_own_test =
        program.name == "deadlock" || program.name == "farm" || program.name == "iirra";
    if (has_own_test) continue;
    if (needs_a_file(program)) continue;  // tests of radiosity run these programs
    std::string declared;
    for (const auto& column : program.columns) declared += column.name + " ";
    const auto measured = occam::isolated([&] {
      std::string names;
      const auto outcome = run_program(program, make_small_setup(model, program));
      for (const auto& [name, cell] : outcome.rows.at(0)) names += name + " ";
      return names;
    });
    EXPECT_EQ(measured, declared) << program.name;
    for (const auto& part : program.parts)
      EXPECT_NE((" " + declared).find(" " + part + " "), std::string::npos) << program.name;
  }
}

struct OwnParams {
  int size = 3;
};
struct OwnMeasured {
  double time_s = 0;
};

Declaration<OwnParams, OwnMeasured> declare_own() {
  using D = base::Declare<OwnParams>;
  return {
      .name = "own",
      .help = "a program of a user",
      .fields = {D::whole("size", &OwnParams::size, 0, 9, "", "size")},
      .columns = {column("time_s", &OwnMeasured::time_s, "time")},
      .run = [](const Setup&, const OwnParams& params) { return OwnMeasured{1.0 * params.size}; }};
}

TEST(OwnPrograms, AreAddedBehindTheOthers) {
  EXPECT_EQ(occam::isolated([] {
              const auto before = all_programs().size();
              add_programs({make_program(declare_own())});
              const auto* own = find_program("own");
              const bool is_last =
                  all_programs().size() == before + 1 && own == &all_programs().back();
              return fmt::format("{} {}", is_last, own->parameters.at(0).name);
            }),
            "true size");
}

TEST(OwnPrograms, BadDeclarationsAreRefusedAndNothingIsAdded) {
  using D = base::Declare<OwnParams>;
  const auto before = all_programs().size();
  const auto refuse = [&](const auto& change, const std::string& expected) {
    auto bad = declare_own();
    bad.name = "bad";
    change(bad);
    const auto message = ::test::message_of<base::BadInput>([&] {
      add_programs({make_program(declare_own()), make_program(bad)});
    });
    EXPECT_NE(message.find(expected), std::string::npos) << message;
    EXPECT_EQ(all_programs().size(), before);
  };
  refuse([](auto& d) { d.name = "own"; }, "two programs of the name \"own\"");
  refuse([](auto& d) { d.name = "farm"; }, "two programs of the name \"farm\"");
  refuse([](auto& d) { d.name = "My own"; }, "found the name \"My own\"");
  refuse([](auto& d) { d.run = nullptr; }, "program bad: found no function run");
  refuse([](auto& d) { d.columns.push_back(d.columns[0]); }, "found the column \"time_s\"");
  refuse([](auto& d) { d.columns[0].name = "size"; }, "found the column \"size\"");
  refuse([](auto& d) { d.fields[0].name = "workers"; }, "found the parameter \"workers\"");
  refuse([](auto& d) { d.fields = {D::whole("size", &OwnParams::size, 5, 9, "", "")}; },
         "found 3 as the default of size, expected");
}

TEST(Programs, OneAdditionIsEnoughForFlops) {
  const auto mflops = occam::isolated([&] {
    const auto model = machine::load_model("t805-25");
    const auto& program = get_program("flops");
    const auto one =
        run_program(program, make_small_setup(model, program), {{"operations", std::int64_t{1}}});
    return fmt::format("{}", get_number(one.rows.at(0), "mflops"));
  });
  EXPECT_GT(std::stod(mflops), 0);
}

TEST(Programs, ProgressiveRefinementTellsItsCyclesSoFar) {
  const auto told = occam::isolated([&] {
    const auto model = machine::load_model("t805-25");
    const auto& program = get_program("progressive");
    const auto outcome = run_program(program, make_small_setup(model, program),
                                     {{"width", std::int64_t{16}}, {"height", std::int64_t{16}}});
    std::string growing;
    double before = 0;
    for (const auto& row : outcome.growth) {
      const double cycles = get_number(row, "cycles_spent");
      growing += cycles > before ? "+" : "-";
      before = cycles;
    }
    return growing;
  });
  EXPECT_GT(told.size(), 2u);
  EXPECT_EQ(told, std::string(told.size(), '+'));
}

// A message must take the time to start the sender's link, then the time of its bytes one after
// another.
TEST(Programs, AMessageTakesItsStartAndItsBytes) {
  const auto model = occam::make_exact_model();
  const auto& message = get_program("message");
  for (const std::int64_t bytes : {1, 80, 3000}) {
    const auto found = occam::isolated_numbers([&] {
      const auto outcome =
          run_program(message, make_small_setup(model, message), {{"bytes", bytes}});
      return occam::Numbers{get_number(outcome.rows.at(0), "latency_s")};
    });
    EXPECT_NEAR(found.at(0) * model.cpu.clock.value,
                static_cast<double>(model.channel.blocked.value + 16 * bytes), 1e-3);
  }
}

// A single processor has no link. A packet to itself passes only the queue of its client.
TEST(Programs, ANetworkDeliversToItsSender) {
  const auto model = machine::load_model("t805-25");
  const auto found = occam::isolated_numbers([&] {
    const programs::Setup setup{model, topologies::make_topology("line:1")};
    const Row row = run_program("unicast", setup, {{"hops", 0}}).rows.at(0);
    return occam::Numbers{get_number(row, "latency_s"), get_number(row, "guards")};
  });
  EXPECT_GT(found.at(0), 0);
  // Guards of that queue: a packet from the entry, and the signal that the sender is free.
  EXPECT_EQ(found.at(1), 2);
}

// A program that would run for ever must stop at a date of its own. An earlier limit set by the
// user must end it without results; a later limit must have no effect.
TEST(Programs, WithoutAnEndRunUpToTheirDateOrTheUsersLimit) {
  const auto model = machine::load_model("t805-25");
  const auto& program = get_program("random_traffic");
  const auto run_until = [&](double until_s) {
    return occam::isolated([&]() -> std::string {
      auto setup = make_small_setup(model, program);
      observe::RunMonitor monitor;
      monitor.until = {until_s};
      setup.monitor = &monitor;
      try {
        const auto outcome = run_program(program, setup, {{"window_s", 0.01}});
        return fmt::format("{} rows, limit {}", outcome.rows.size(), monitor.until.value);
      } catch (const Unfinished& error) {
        return error.what();
      }
    });
  };
  EXPECT_EQ(run_until(0.02), "4 rows, limit 0.02");
  EXPECT_NE(run_until(0.005).find("the run ended early at 0.005"), std::string::npos)
      << run_until(0.005);
}

TEST(Programs, OfRoutersNeedTwoProcessors) {
  const auto model = machine::load_model("t805-25");
  for (const char* name : {"random_traffic", "global", "router_load", "soak"})
    EXPECT_NE(occam::isolated([&]() -> std::string {
                try {
                  programs::Setup setup{model, topologies::make_topology("line:1")};
                  setup.routes = topologies::make_routes(setup.topology);
                  run_program(name, setup);
                  return "";
                } catch (const base::BadInput& error) {
                  return error.what();
                }
              }),
              "")
        << name;
}

// The latency is a mean over the packets of the window's second half. Without packets it must be
// empty.
TEST(Programs, AMeanLatencyOfNoPacketIsEmpty) {
  const auto model = machine::load_model("t805-25");
  const double load = 0.0006, window_s = 0.5;
  int without = 0, with = 0;
  for (std::int64_t seed = 1; seed <= 10; ++seed) {
    const auto arrivals = make_uniform_traffic(4, load * model.link.one_way_rate / 1000,
                                               1e6 * window_s, static_cast<std::uint64_t>(seed));
    if (arrivals.empty()) continue;
    const bool is_empty = std::ranges::none_of(
        arrivals, [&](const auto& arrival) { return arrival.at_us > 1e6 * window_s / 2; });
    const auto found = occam::isolated([&] {
      const programs::Setup setup{model, topologies::make_topology("mesh:2x2")};
      const auto outcome = run_program(
          "traffic", setup,
          {{"bytes", std::int64_t{1000}}, {"load", load}, {"window_s", window_s}, {"seed", seed}});
      const bool has_none = get_cell(outcome.rows.at(0), "latency_s") == base::Cell();
      return std::string(has_none ? "empty" : "a number");
    });
    EXPECT_EQ(found, is_empty ? "empty" : "a number") << seed;
    ++(is_empty ? without : with);
  }
  EXPECT_GT(without, 0);
  EXPECT_GT(with, 0);
}

// The only link is cut before the first message, so the mean length of routes must be empty.
TEST(Programs, AMeanWayOfNoMessageIsEmpty) {
  const auto model = machine::load_model("t805-25");
  const auto run = [&](std::vector<PlannedFault> faults) {
    return occam::isolated([&] {
      programs::Setup setup{model, topologies::make_topology("line:2")};
      setup.routes = topologies::make_routes(setup.topology);
      setup.faults = std::move(faults);
      const auto row = run_program("soak", setup, {{"messages", std::int64_t{20}}}).rows.at(0);
      const bool has_none = get_cell(row, "links_mean") == base::Cell();
      return fmt::format("{} {}", get_number(row, "delivered"), has_none ? "empty" : "a number");
    });
  };
  EXPECT_EQ(run({}), "20 a number");
  EXPECT_EQ(run({{.at_s = 0, .a = 0, .b = 1}}), "0 empty");
}

TEST(Programs, SharesOfNoAccessesAndNoRequestsAreEmpty) {
  const std::set<std::string> shares{
      "local",   "on_path",           "by_queue",          "at_coordinator",
      "on_disk", "links_per_request", "wait_per_request_s"};
  shared_memory::DataUse some;
  some.found[0] = some.requests = 1;
  for (const auto& [use, is_empty] : {std::pair(shared_memory::DataUse{}, true), {some, false}})
    for (const auto& [name, cell] : base::make_row(shared_memory::data_columns(), use))
      EXPECT_EQ(cell == base::Cell(), is_empty && shares.contains(name)) << name;
}

// Two messages are sent within the window of 2 ms. One of them arrives shortly after the window's
// end.
TEST(Programs, ARouterThatIsLateForAMomentIsNotSaturated) {
  const auto found = occam::isolated([] {
    const auto model = machine::load_model("t805-25");
    programs::Setup setup{model, topologies::make_topology("line:4")};
    setup.routes = topologies::make_routes(setup.topology);
    const auto outcome = run_program(
        "router_load", setup,
        {{"warm_up_s", 0.0}, {"window_s", 0.002}, {"load", 0.002}, {"seed", std::int64_t{6}}});
    const Row& row = outcome.rows.at(0);
    return fmt::format("{} {} {}", get_number(row, "accepted_per_s"), get_number(row, "overflowed"),
                       get_number(row, "saturated"));
  });
  EXPECT_EQ(found, "125 0 0");  // rate in 1/s of one message in 2 ms from 4 processors
}

TEST(Programs, ShowOnlyColumnsThatTheyHave) {
  for (const Program& program : all_programs()) {
    SCOPED_TRACE(program.name);
    auto shown = base::join(program.shows.summary, {program.shows.loads});
    for (const auto& plot : program.shows.plots) shown.push_back(plot.column);
    for (const auto& name : shown)
      EXPECT_NE(std::ranges::find(program.columns, name, &ColumnHelp::name), program.columns.end())
          << name;
  }
}

TEST(Programs, ParametersKnowWhatTheyAllow) {
  const auto& program = get_program("global");
  std::any params = program.defaults;
  const auto* method = program.find("method");
  EXPECT_EQ(method->get(params), base::Scalar("green"));
  EXPECT_EQ(method->assign(params, "chalmers"), "");
  EXPECT_EQ(method->get(params), base::Scalar("chalmers"));
  EXPECT_EQ(method->assign(params, "classes"), "one of green, chalmers, acyclic, naive");
  EXPECT_EQ(program.find("window")->assign(params, 0), "a whole number from 1 to 1000000");
  EXPECT_EQ(program.find("missing"), nullptr);
  const auto& sources = get_program("sources");
  std::any of_sources = sources.defaults;
  EXPECT_EQ(sources.find("messages")->assign(of_sources, 4), "");
  EXPECT_EQ(sources.find("messages")->assign(of_sources, 3), "a whole number from 4 to 10000000");
}

// The keys of a stage ([[stage]] in an experiment file) must accept valid limits and refuse invalid
// ones.
TEST(Programs, LimitsOfAStageKnowWhatTheyAllow) {
  for (const char* name : {"farm", "iirra"}) {
    SCOPED_TRACE(name);
    const auto& lists = get_program(name).lists;
    const auto stage = std::ranges::find(lists, "stage", &RecordList::key);
    ASSERT_NE(stage, lists.end());
    const auto assign = [&](const char* field, const base::Scalar& value) {
      std::any record = stage->make_record();
      const auto found = std::ranges::find(stage->fields, field, &Parameter::name);
      return found == stage->fields.end() ? "no such field" : found->assign(record, value);
    };
    for (const double good : {0.0, 0.5, 1.0}) EXPECT_EQ(assign("min_influence", good), "");
    for (const double bad : {-0.5, 1.5})
      EXPECT_EQ(assign("min_influence", bad), "a number from 0 to 1");
    for (const char* depth : {"depth_reflected", "depth_transmitted"}) {
      for (const int good : {0, 1, 1000}) EXPECT_EQ(assign(depth, good), "");
      for (const int bad : {-1, 1001})
        EXPECT_EQ(assign(depth, bad), "a whole number from 0 to 1000");
    }
    EXPECT_EQ(assign("min_cell", 1), "");
    EXPECT_NE(assign("min_cell", 0), "");
  }
}

}  // namespace
}  // namespace programs
