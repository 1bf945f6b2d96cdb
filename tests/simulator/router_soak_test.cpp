// Every message over random networks arrives once, at its place and in order, whatever the method.
#include <gtest/gtest.h>

#include <random>

#include "simulator/patterns/soak.hpp"
#include "tests/simulator/support.hpp"
#include "topologies/generators.hpp"

namespace {

using network::Method;
using patterns::SoakParams;

patterns::SoakResult soak(const topologies::Topology& topology, const SoakParams& params) {
  return run_soak(
      machine::load_model("t805-25"),
      network::make_routing(params.network.method, topology, topologies::make_routes(topology)),
      params);
}

}  // namespace

TEST(RouterSoak, SixBySixTorus) {
  for (const Method method : {Method::chalmers, Method::green, Method::acyclic}) {
    SoakParams params;
    params.network.method = method;
    params.messages = 100000;
    const auto start = std::clock();
    const auto r = soak(topologies::make_topology("torus:6x6"), params);
    fmt::print("{}: {} of {} lost {} dup {} reord {} mis {} held {} {:.2f} s host {:.1f}\n",
               static_cast<int>(method), r.delivered, r.expected, r.lost, r.duplicated, r.reordered,
               r.misdelivered, r.use.most_held, r.time_s,
               double(std::clock() - start) / CLOCKS_PER_SEC);
  }
}
