#pragma once
// What a run of IIRRA measures, and the columns that show it.
#include "simulator/iirra/iirra.hpp"

namespace iirra {

struct Measured {
  Measured(Result result, tracing::DataFigures data_figures);

  Result run;
  tracing::DataFigures data;
  tracing::Busy busy;
  growth::Figures growth = {};
  tracing::Loads loads;  ///< the busiest first
};

/// The resources of tracing::find_loads; the process "coordination", unless it waits for a message;
/// the display's CPU; and "tasks": the share of the time after the last task was taken.
tracing::Loads find_loads(const Result& result);

base::Columns<Measured> make_columns();

}  // namespace iirra
