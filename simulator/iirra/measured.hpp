#pragma once
// Measurements of an IIRRA run, and their columns.
#include <cmath>

#include "simulator/iirra/iirra.hpp"

namespace iirra {

/// Fractions of the workers' time not spent on rays of the final image. Together with the time for
/// these rays they sum to 1.
struct Losses {
  double idle = NAN;      ///< without a task, or waiting for the display
  double data = NAN;      ///< waiting for scene data
  double repeated = NAN;  ///< rays of samples outside the image, or traced by several workers
  double routing = NAN;   ///< high-priority processes
  double managing = NAN;  ///< tasks, pictures, messages and data look-ups
  base::Cell largest;     ///< name of the largest fraction
};
/// All fractions are NaN if the run was cut short before its first ray.
Losses find_losses(const Result& result);

struct Measured {
  Measured(Result result, ray_tracing::DataFigures data_figures);

  Result run;
  ray_tracing::DataFigures data;
  ray_tracing::Busy busy;
  Losses losses;
  snapshots::Figures growth = {};
  ray_tracing::Loads loads;
};

/// Possible bottlenecks: the resources of ray_tracing::find_loads, the display's CPU, and two more.
/// "coordination" is the fraction of time in which this process did not wait for messages. "tasks"
/// is the fraction of time after the last task was taken.
ray_tracing::Loads find_loads(const Result& result);

base::Columns<Measured> make_columns();

}  // namespace iirra
