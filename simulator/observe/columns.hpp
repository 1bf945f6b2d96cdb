#pragma once
// What is said of messages and links wherever it is measured.
#include "base/fields.hpp"
#include "simulator/observe/use.hpp"

namespace observe {

/// messages_sent, bytes_sent.
base::Columns<Use> message_columns();
/// link_busy_max.
base::Column<Use> link_busy_column();

}  // namespace observe
