#pragma once
// Progressive radiosity on a machine, as in AMP (thesis 5.1; A. Chalmers and D. Paddon, "Parallel
// Processing of Progressive Refinement Radiosity Methods", 1991). Patches are distributed over the
// processors. A reduction along a tree finds the brightest patch, which is broadcast. Each receiver
// computes its form factors and updates. The topology's root is root of the tree and display.
//
// Not charged: distributing the patches, and comparing candidates on their way up. Drawing pictures
// at the display is charged only if costs are timed.
#include <functional>
#include <optional>

#include "simulator/kernels/kernels.hpp"
#include "simulator/observe/run_monitor.hpp"
#include "simulator/observe/use.hpp"
#include "simulator/parallel_radiosity/distribution.hpp"
#include "simulator/programs/declare/other_models.hpp"
#include "simulator/shared_memory/virtual_memory.hpp"

namespace parallel_radiosity {

/// Illumination at the display after a number of shots.
struct Frame {
  int shots = 0;
  double at_s = 0;  ///< s, when it was complete at the display
  double unshot = 0;
  std::vector<radiosity::Rgb> vertices;  ///< radiosity, by vertex, without ambient
  radiosity::Rgb ambient;
};

struct Params {
  radiosity::SolveParams solve;  ///< its tolerance, shots and form factors
  Distribution distribution = Distribution::tiles;
  /// True: one processor computes a border vertex and sends it to the others; else each does.
  bool exchange = true;
  network::Method method = network::Method::green;
  int show_every = 0;  ///< shots between two pictures sent to the display; 0: only the last
  /// Cache of each processor's data manager, in percent of the geometry's bytes, up to 100. 0:
  /// every processor holds all faces and their hierarchy.
  double cache_percent = 0;
  /// If set, charges kernels by host time, with this factor; else by operation counts.
  std::optional<double> cycles_per_host_s;
  programs::OtherModels others = {};
  machine::EngineParams engine = {};
  /// Draws a frame's picture, to charge the host time of drawing, which counts no operations. Null:
  /// drawing is not charged.
  std::function<void(const Frame&)> draw;
  /// Picture of a frame for the live page; black for null, before the first frame.
  std::function<renderer::Bitmap(const Frame*)> look;
  observe::RunMonitor* monitor = nullptr;  ///< supplies limit and trace; may be null
};

/// Shares of the processors' time; they sum to 1.
struct Loss {
  double useful = 0;    ///< kernels, counting each vertex once
  double repeated = 0;  ///< vertices computed by two processors with adjacent patches; by number,
                        ///< assuming equal times
  double unequal = 0;   ///< waiting for the busiest processor of a shot
  double messages = 0;  ///< the rest: reduction, broadcast, borders, pictures, routers, and data
                        ///< managers if geometry is shared
};

struct Result {
  double time_s = 0;   ///< until the last shot is done everywhere, including intermediate pictures
  double total_s = 0;  ///< until the display has the last frame
  int shots = 0;
  std::vector<Frame> frames;  ///< the last one is the solution
  Loss loss;
  renderer::Work work;                      ///< of all processors
  std::uint64_t vertices_done_max = 0;      ///< most vertices computed by one processor in a shot
  machine::Cycles kernel_cycles{};          ///< charged to all processors
  std::vector<kernels::KernelUse> kernels;  ///< kernels called on any processor
  observe::Use use;                         ///< over time_s
  shared_memory::DataUse data;              ///< if cache_percent > 0
  network::RouterUse routers;
  machine::End end = machine::End::done;  ///< otherwise results up to that point, possibly without
                                          ///< any frame
  std::uint64_t events = 0;
};

/// Throws base::BadInput naming the field, what was found and what was expected.
void check(const machine::Model& model, const radiosity::Mesh& mesh, int processors,
           const Params& params);

/// The solution equals that of radiosity::solve bit for bit. Throws base::BadInput as `check` does,
/// or if patches, geometry and buffers exceed a processor's memory; and machine::Fault.
Result run_radiosity(const machine::Model& model, const topologies::Topology& topology,
                     const radiosity::Mesh& mesh, const Params& params);

}  // namespace parallel_radiosity
