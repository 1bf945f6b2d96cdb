#pragma once
// Processes around the coordination (thesis, 4.3.6.4 to 4.3.6.6): interaction, ray database and
// visualisation.
#include <vector>

#include "renderer/image/image.hpp"
#include "simulator/farm/messages.hpp"
#include "simulator/farm/ray_stores.hpp"
#include "simulator/machine/model.hpp"

namespace farm {

/// The user, scripted: an order sent at a simulated date.
struct Order {
  machine::Seconds at;
  Command command;
};
void interaction(const std::vector<Order>& script, Channel<Command>& into_coordination);

/// Stores rays, and gives them back by priority (figure 4.16).
struct RayDatabase {
  RayStores stores;
  machine::OperationCosts cost;
  kernels::RecordBytes bytes;
  void run(Channel<DatabaseRequest>& from_coord, Channel<DatabaseReply>& into_coord);
};

/// The image as it was when the limits of a stage were reached.
struct KeyImage {
  machine::Seconds at;
  renderer::Samples samples;
};

/// Adds what each ray contributes to its sample as it arrives (figure 4.17, Eq 4.26 to 4.28).
struct Visualisation {
  const renderer::Scene& scene;
  const renderer::Params& params;
  machine::OperationCosts cost;
  renderer::Samples samples;
  std::vector<KeyImage> key_images;
  void run(Channel<Answer>& inp);
};

}  // namespace farm
