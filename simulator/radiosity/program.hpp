#pragma once
// The parts of the program radiosity: what is measured of a run, and its pictures.
#include "simulator/radiosity/radiosity.hpp"
#include "simulator/radiosity/rooms.hpp"

namespace programs {

// Columns of results.csv: sizes, times, losses, loads.
Row make_radiosity_row(const radiosity::Mesh& mesh, const amp::Result& result, bool has_data);
// Of the patches, by area, all colours alike; only of materials that have patches in both meshes.
double mean_radiosity(const radiosity::Mesh& mesh, const std::vector<radiosity::Rgb>& vertices,
                      const radiosity::Mesh& other);
// "81 % of the time is useful; the largest loss: 9 % waiting for ...".
std::string describe_loss(const amp::Loss& loss, bool has_data);

// Adds the pictures to the run's, and what a comparison with the reference tells to its row.
void add_pictures(const Setup& setup, MeshedRoom room, const std::vector<amp::Frame>& frames,
                  Rows& rows);

}  // namespace programs
