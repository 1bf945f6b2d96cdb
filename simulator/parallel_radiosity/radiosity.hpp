#pragma once
// Progressive radiosity on a machine, as in AMP (thesis 5.1; A. Chalmers and D. Paddon, "Parallel
// Processing of Progressive Refinement Radiosity Methods", 1991). Patches are distributed over the
// processors. A reduction along a tree finds the brightest patch, which is broadcast. Each receiver
// computes its form factors and updates its patches. The root of the topology is the root of the
// tree and the display.
//
// Two things are not charged: distributing the patches, and comparing candidates on their way up.
// Drawing pictures on the display is charged only if costs are timed.
#include <functional>
#include <optional>

#include "simulator/kernels/kernels.hpp"
#include "simulator/observe/use.hpp"
#include "simulator/parallel_radiosity/distribution.hpp"
#include "simulator/programs/declare/program.hpp"
#include "simulator/shared_memory/virtual_memory.hpp"

namespace parallel_radiosity {

using programs::Setup;

/// The illumination known to the display after a number of shots.
struct Frame {
  int shots = 0;
  double at_s = 0;  ///< in seconds; when the frame was complete at the display
  double unshot = 0;
  std::vector<radiosity::Rgb> vertices;  ///< radiosity by vertex, without ambient light
  radiosity::Rgb ambient;
};

struct Params {
  radiosity::SolveParams solve;  ///< tolerance, shots and form factors
  Distribution distribution = Distribution::tiles;
  /// True: one processor computes a border vertex and sends it to the others. False: each processor
  /// computes it.
  bool exchange = true;
  network::Method method = network::Method::green;
  /// Number of shots between pictures sent to the display; 0 for the last picture only.
  int show_every = 0;
  /// Cache size of each processor's data manager in percent of the geometry's bytes, up to 100. 0:
  /// every processor holds all faces and their hierarchy.
  double cache_percent = 0;
  /// Draws a frame's picture, so that the host time of drawing can be charged; drawing has no
  /// operation counts. If null, drawing is not charged.
  std::function<void(const Frame&)> draw;
  /// Draws a frame for the live page. Before the first frame, the argument is null and the picture
  /// is black.
  std::function<renderer::Bitmap(const Frame*)> look;
};

/// Fractions of the processors' time, which sum to 1.
struct Loss {
  double useful = 0;  ///< kernels, with each vertex counted once
  /// Vertices that several processors compute because they own adjacent patches. Estimated from the
  /// number of vertices, assuming that all take equal time.
  double repeated = 0;
  double unequal = 0;  ///< waiting for the busiest processor of each shot
  /// All other time: reduction, broadcast, borders, pictures, routers, and data managers if
  /// geometry is distributed.
  double messages = 0;
};

struct Result {
  /// Time until all processors have finished the last shot. Includes sending intermediate pictures.
  double time_s = 0;
  double total_s = 0;  ///< until the display has received the last frame
  int shots = 0;
  std::vector<Frame> frames;  ///< the last frame is the solution
  Loss loss;
  renderer::Work work;                      ///< total over all processors
  std::uint64_t vertices_done_max = 0;      ///< maximum number per processor and shot
  machine::Cycles kernel_cycles{};          ///< charged to all processors
  std::vector<kernels::KernelUse> kernels;  ///< the kernels called on any processor
  observe::Use use;                         ///< use of the machine during time_s
  shared_memory::DataUse data;              ///< filled only if cache_percent > 0
  network::RouterUse routers;
  /// If not `done`, results cover the run up to this end and may lack frames.
  machine::End end = machine::End::done;
  std::uint64_t events = 0;
};

/// Throws base::BadInput that names the field, the value found and the values expected.
void check(const machine::Model& model, const radiosity::Mesh& mesh, int processors,
           const Params& params);

/// Runs the program. The solution equals that of radiosity::solve bit for bit. Throws
/// base::BadInput as `check` does, or if patches, geometry and buffers exceed a processor's memory.
/// Also throws machine::Fault.
Result run_radiosity(const Setup& setup, const radiosity::Mesh& mesh, const Params& params);

}  // namespace parallel_radiosity
