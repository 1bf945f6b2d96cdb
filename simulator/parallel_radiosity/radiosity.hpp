#pragma once
// Progressive radiosity on a machine, as in AMP (thesis, 5.1; A. Chalmers and D. Paddon, "Parallel
// Processing of Progressive Refinement Radiosity Methods", 1991). Patches are distributed over the
// processors. In each step a reduction along a tree finds the brightest patch, and the root
// broadcasts it. Every processor then computes the form factors from this patch to its own patches
// and updates them. The root of the topology is the root of the tree and the display.
//
// Two things are not charged: distributing the patches, and comparing candidates on their way up
// the tree. Drawing pictures on the display is charged only if costs are host times.
#include <functional>
#include <optional>

#include "simulator/kernels/kernels.hpp"
#include "simulator/observe/use.hpp"
#include "simulator/parallel_radiosity/distribution.hpp"
#include "simulator/programs/declare/program.hpp"
#include "simulator/shared_memory/virtual_memory.hpp"

namespace parallel_radiosity {

using programs::Setup;

/// The illumination that the display has after a number of shots.
struct Frame {
  int shots = 0;
  /// Date in s at which the display had received the whole frame.
  double at_s = 0;
  double unshot = 0;                     ///< fraction of the light that has not been shot
  std::vector<radiosity::Rgb> vertices;  ///< radiosity of each vertex, without ambient light
  radiosity::Rgb ambient;
};

struct Params {
  radiosity::SolveParams solve;  ///< tolerance, maximum number of shots, and form factors
  Distribution distribution = Distribution::tiles;
  /// If true, one processor computes the light of a shared vertex and sends it to the other
  /// processors that share the vertex. If false, each of them computes the light itself.
  bool exchange = true;
  network::Method method = network::Method::green;
  /// Number of shots between two pictures sent to the display; 0 means only the last picture.
  int show_every = 0;
  /// Cache size of each processor's data manager, in percent of the geometry's bytes, up to 100.
  /// With 0, there are no data managers, and every processor holds all faces and their hierarchy.
  double cache_percent = 0;
  /// Draws the picture of a frame, so that the host time of drawing can be measured and charged.
  /// Drawing has no operation counts. If null, drawing is not charged.
  std::function<void(const Frame&)> draw;
  /// Draws the picture of a frame for the live page. Before the first frame the argument is null,
  /// and the picture must be black.
  std::function<renderer::Bitmap(const Frame*)> look;
};

/// Fractions of the processors' time. They sum to 1.
struct Loss {
  double useful = 0;  ///< time in kernels; a vertex that several processors compute counts once
  /// Repeated computation of vertices that several processors share, because they own adjacent
  /// patches. Estimated from numbers of vertices, as if all vertices took equal time.
  double repeated = 0;
  double unequal = 0;  ///< waiting for the processor with the most work in each shot
  /// All other time: reduction, broadcast, light of shared vertices, pictures, routers, and data
  /// managers if geometry is distributed.
  double messages = 0;
};

struct Result {
  /// Time until all processors have finished the last shot. Includes the sending of intermediate
  /// pictures.
  double time_s = 0;
  double total_s = 0;  ///< time until the display has received the last frame
  int shots = 0;
  std::vector<Frame> frames;  ///< the last frame is the solution
  Loss loss;
  renderer::Work work;  ///< sum over all processors
  /// Maximum number of vertices that a processor computes in a shot.
  std::uint64_t vertices_done_max = 0;
  machine::Cycles kernel_cycles{};          ///< cycles charged for kernels on all processors
  std::vector<kernels::KernelUse> kernels;  ///< the kernels called on any processor
  observe::Use use;                         ///< use of the machine up to time_s
  shared_memory::DataUse data;              ///< empty unless cache_percent > 0
  network::RouterUse routers;
  /// Reason for the end of the run. If it is not `done`, results cover the time up to this end, and
  /// frames may be missing.
  machine::End end = machine::End::done;
  std::uint64_t events = 0;
};

/// Throws base::BadInput that names the field, the value found and the values expected.
void check(const machine::Model& model, const radiosity::Mesh& mesh, int processors,
           const Params& params);

/// Runs the program. The solution equals that of radiosity::solve bit for bit. Throws
/// base::BadInput if check() would, or if patches, geometry and buffers exceed a processor's
/// memory. Also throws machine::Fault.
Result run_radiosity(const Setup& setup, const radiosity::Mesh& mesh, const Params& params);

}  // namespace parallel_radiosity
