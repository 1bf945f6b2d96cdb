#pragma once
// Measurements of an IIRRA run, and their columns.
#include "simulator/iirra/iirra.hpp"

namespace iirra {

/// Shares of the workers' time not spent on the image's rays. With these rays they sum to 1.
struct Losses {
  double idle = 0;      ///< without a task or waiting for the display
  double data = 0;      ///< waiting for scene data
  double repeated = 0;  ///< rays of samples beyond the image or computed by another worker too
  double routing = 0;   ///< high-priority processes
  double managing = 0;  ///< tasks, pictures, messages, data look-ups
  std::string largest;  ///< name of the largest share
};
/// All 0 for a run cut short before its first task.
Losses find_losses(const Result& result);

struct Measured {
  Measured(Result result, ray_tracing::DataFigures data_figures);

  Result run;
  ray_tracing::DataFigures data;
  ray_tracing::Busy busy;
  Losses losses;
  snapshots::Figures growth = {};
  ray_tracing::Loads loads;  ///< busiest first
};

/// Resources of ray_tracing::find_loads; the process "coordination" while not waiting for a
/// message; the display's CPU; and "tasks": the share of the time after the last task was taken.
ray_tracing::Loads find_loads(const Result& result);

base::Columns<Measured> make_columns();

}  // namespace iirra
