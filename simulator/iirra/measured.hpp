#pragma once
// Measurements of an IIRRA run, and their columns.
#include <cmath>

#include "simulator/iirra/iirra.hpp"
#include "simulator/ray_tracing/program.hpp"

namespace iirra {

/// Fractions of the workers' time that do not serve to trace rays of the final image. Together with
/// the fraction that does, they sum to 1.
struct Losses {
  double idle = NAN;  ///< the worker has no task, or waits for the display
  double data = NAN;  ///< the worker waits for scene data
  /// the worker spends time on samples outside the image, or on rays that several workers traced
  double repeated = NAN;
  double routing = NAN;   ///< spent in high-priority processes, which route messages
  double managing = NAN;  ///< spent on tasks, pictures, messages and searches for scene data
  base::Cell largest;     ///< name of the largest fraction
};
/// All fractions are NaN if the run was cut short before its first ray.
Losses find_losses(const Result& result);

/// Possible bottlenecks, as listed at ray_tracing::find_loads. "coordination" is the fraction of
/// time in which the coordinator does not wait for messages. "tasks" is the fraction of time after
/// a worker took the last task.
ray_tracing::Loads find_loads(const Result& result);

struct Measured : ray_tracing::Measured<Result> {
  Measured(Result result, ray_tracing::DataFigures figures)
      : ray_tracing::Measured<Result>(std::move(result), std::move(figures)),
        losses(find_losses(run)) {}

  Losses losses;
};

base::Columns<Measured> make_columns();

}  // namespace iirra
