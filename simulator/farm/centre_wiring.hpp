#pragma once
// The three central processors of the farm, what their processes keep, and the channels between
// them (figures 4.9 to 4.11).
#include "simulator/farm/farm.hpp"
#include "simulator/farm/wiring.hpp"

namespace farm {

/// Coordinator, ray database and display on processors of their own; the second and the third are
/// on links of the first.
struct CentralProcessors {
  machine::Processor &coordinator, &database, &display;
};

class Centre {
 public:
  Centre(machine::Machine& machine, const renderer::Scene& scene, const Params& params);
  Centre(const Centre&) = delete;

  machine::Processor& coordinator() { return on_.coordinator; }
  /// Starts the processes: the coordination of rays or of blocks.
  void start(Wires& wires, const Workers& workers);
  /// The result without the workers' part.
  Result take_result(machine::End end);

 private:
  SceneMessages scene_messages(std::size_t workers) const;
  CoordinationSetup make_ray_setup(std::size_t workers) const;

  machine::Machine& machine_;
  const Params& params_;
  const renderer::Scene& scene_;
  kernels::RecordBytes bytes_;
  CentralProcessors on_;
  machine::OperationCosts cost_;
  std::vector<Order> script_;
  RayDatabase rays_;
  Visualisation visualisation_;
  Progress progress_;

  Channel<Command> from_interaction_;
  Channel<DatabaseRequest> into_database_;
  Channel<DatabaseReply> from_database_;
  Channel<Answer> into_visualisation_;
};

}  // namespace farm
