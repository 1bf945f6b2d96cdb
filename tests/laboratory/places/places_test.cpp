// Positions of a machine's processors in drawings.
#include "experiments/laboratory/places/places.hpp"

#include <gtest/gtest.h>

#include "tests/support/lab.hpp"
#include "topologies/make/generators.hpp"

namespace laboratory {
namespace {

using topologies::Place;

struct PlacesOf : testing::Test {
  occam::Lab lab{occam::make_exact_model(), machine::Code::bare, {.links = machine::Links::direct}};
};

void expect_place(const Place& found, double x, double y) {
  EXPECT_DOUBLE_EQ(found.x, x);
  EXPECT_DOUBLE_EQ(found.y, y);
}

TEST_F(PlacesOf, ANetworkAreThoseOfItsDrawing) {
  const auto network = topologies::make_line(3);
  const auto drawn = topologies::make_layout(network).processors;
  auto* last = &lab.cpu();  // processor 0, which is outside the network, above its root
  for (int i = 0; i < 3; ++i) last = &lab.neighbour(*last);
  const auto places = place_processors(lab.machine, network, {1, 2, 3});
  ASSERT_EQ(places.size(), 4u);
  for (std::size_t i = 0; i < 3; ++i) expect_place(places[i + 1], drawn[i].x, drawn[i].y);
  expect_place(places[0], drawn[0].x, drawn[0].y + 1);
}

// A processor outside the network is placed above its neighbour if that position is free. Rounding
// may make the distance to another processor slightly less than 1.
TEST_F(PlacesOf, OthersAreBesideThoseThatTheyAreJoinedTo) {
  auto& root = lab.cpu();
  lab.neighbour(root);
  for (const double y : {0., 0.4, 0.9, 1.3, 3.1})
    expect_place(place_others(lab.machine, {Place{0, y}, {}}).at(1), 0, y + 1);
  lab.neighbour(root);
  const auto places = place_others(lab.machine, {Place{2, 0}, {}, {}});
  expect_place(places.at(1), 2, 1);
  expect_place(places.at(2), 1, 1);
}

TEST_F(PlacesOf, ThoseThatNothingIsJoinedToAreInARow) {
  for (int i = 0; i < 3; ++i) lab.cpu();
  const auto places = place_others(lab.machine, SomePlaces(3));
  for (int i = 0; i < 3; ++i) expect_place(places.at(static_cast<std::size_t>(i)), i, -1);
}

}  // namespace
}  // namespace laboratory
