#pragma once
// Measurements of an IIRRA run, and their columns.
#include <cmath>

#include "simulator/iirra/iirra.hpp"
#include "simulator/ray_tracing/program.hpp"

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

/// Possible bottlenecks, see ray_tracing::find_loads. "coordination" is the fraction of time in
/// which this process does not wait for messages, and "tasks" that after the last task was taken.
ray_tracing::Loads find_loads(const Result& result);

struct Measured : ray_tracing::Measured<Result> {
  Measured(Result result, ray_tracing::DataFigures figures)
      : ray_tracing::Measured<Result>(std::move(result), std::move(figures)),
        losses(find_losses(run)) {}

  Losses losses;
};

base::Columns<Measured> make_columns();

}  // namespace iirra
