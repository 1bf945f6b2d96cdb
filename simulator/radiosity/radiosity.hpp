#pragma once
// Progressive radiosity on a machine, as in AMP (thesis 5.1; A. Chalmers and D. Paddon, "Parallel
// Processing of Progressive Refinement Radiosity Methods", 1991): patches are spread over the
// processors; the brightest is found by a reduction along a tree and sent to all; form factors and
// updates are done where the receivers are. The topology's root is the tree's, and the display's.
//
// Not charged: how the patches came to the processors, what it took to share them out, candidates
// compared on their way up; and unless costs are timed, pictures drawn at the display.
#include <functional>
#include <optional>

#include "simulator/declare/other_models.hpp"
#include "simulator/kernels/kernels.hpp"
#include "simulator/observe/use.hpp"
#include "simulator/observe/watch.hpp"
#include "simulator/radiosity/distribution.hpp"
#include "simulator/shared_memory/virtual_memory.hpp"

namespace amp {

/// The illumination as the display has it, after a number of shots.
struct Frame {
  int shots = 0;
  double at_s = 0;  ///< when it was complete at the display
  double unshot = 0;
  std::vector<radiosity::Rgb> vertices;  ///< radiosity, by vertex, without ambient
  radiosity::Rgb ambient;
};

struct Params {
  radiosity::SolveParams solve;  ///< its tolerance, shots and form factors
  Distribution distribution = Distribution::tiles;
  /// A vertex on a border is found by one processor, which tells the others; else by each of them.
  bool exchange = true;
  network::Method method = network::Method::green;
  int show_every = 0;  ///< shots between two pictures sent to the display; 0: only the last
  /// Percentage of the geometry's bytes, up to 100, that each processor's data manager has room
  /// for; 0: every processor has all faces and their hierarchy.
  double cache_percent = 0;
  /// Kernels are charged the host time they take, times this; else their counts.
  std::optional<double> cycles_per_host_s;
  programs::OtherModels others = {};
  machine::EngineParams engine = {};
  /// Draws the picture of a frame, if it is to be charged the host time that it takes: it counts no
  /// operations.
  std::function<void(const Frame&)> draw;
  /// The picture of a frame, for who watches the run; null: before the first.
  std::function<renderer::Bitmap(const Frame*)> look;
  observe::Watch* watch = nullptr;  ///< its limit and trace, if there is one
};

/// Where the processors' time went: shares of it, which add up to 1.
struct Loss {
  double useful = 0;    ///< kernels, each vertex once
  double repeated = 0;  ///< vertices that two processors find, as both have patches there; by their
                        ///< number, as if all took as long
  double unequal = 0;   ///< waiting for the processor with most to do in a shot
  double messages = 0;  ///< the rest: reduction, broadcast, borders, pictures, routers, and where
                        ///< geometry is shared the data managers
};

struct Result {
  double time_s = 0;   ///< until the last shot is done everywhere, pictures on the way included
  double total_s = 0;  ///< until the display has the last frame
  int shots = 0;
  std::vector<Frame> frames;  ///< the last one is the solution
  Loss loss;
  renderer::Work work;                      ///< all processors' work
  std::uint64_t vertices_done_max = 0;      ///< most vertices that a processor finds in a shot
  machine::Cycles kernel_cycles{};          ///< charged, to all
  std::vector<kernels::KernelUse> kernels;  ///< of all processors, those that were called
  observe::Use use;                         ///< over time_s
  shared_memory::DataUse data;              ///< where cache_percent > 0
  network::RouterUse routers;
  machine::End end = machine::End::done;  ///< else all this is what was measured until then, and
                                          ///< there may be no frame
  std::uint64_t events = 0;
};

/// Throws base::BadInput naming the field, what was found and what was expected.
void check(const machine::Model& model, const radiosity::Mesh& mesh, int processors,
           const Params& params);

/// The solution equals radiosity::solve's to the bit. Throws base::BadInput as `check` and if
/// patches, geometry and buffers do not fit the processors' memory; and machine::Fault.
Result run_radiosity(const machine::Model& model, const topologies::Topology& topology,
                     const radiosity::Mesh& mesh, const Params& params);

}  // namespace amp
