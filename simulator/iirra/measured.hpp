#pragma once
// What a run of IIRRA measures, and the columns that show it.
#include "simulator/iirra/iirra.hpp"

namespace iirra {

/// Where the workers' time went, as shares of it; beside the rays of the image, these are all.
struct Losses {
  double idle = 0;      ///< without a task, or waiting for the display
  double data = 0;      ///< waiting for the scene's data
  double repeated = 0;  ///< rays of samples that another computed too, or beyond the image
  double routing = 0;   ///< processes of high priority
  double managing = 0;  ///< tasks, pictures, messages, looking data up
  std::string largest;  ///< which of them
};
/// All 0 for a run that was cut short before its first task.
Losses find_losses(const Result& result);

struct Measured {
  Measured(Result result, tracing::DataFigures data_figures);

  Result run;
  tracing::DataFigures data;
  tracing::Busy busy;
  Losses losses;
  growth::Figures growth = {};
  tracing::Loads loads;  ///< the busiest first
};

/// The resources of tracing::find_loads; the process "coordination", unless it waits for a message;
/// the display's CPU; and "tasks": the share of the time after the last task was taken.
tracing::Loads find_loads(const Result& result);

base::Columns<Measured> make_columns();

}  // namespace iirra
