#include "simulator/observe/columns.hpp"

#include <algorithm>

namespace observe {

base::Columns<Use> message_columns() {
  return {base::column<Use>("messages_sent", &total_messages,
                            "messages over links, counted on each link that they pass"),
          base::column<Use>("bytes_sent", &total_bytes, "bytes of these messages")};
}

base::Column<Use> link_busy_column() {
  return base::column<Use>(
      "link_busy_max",
      [](const Use& use) {
        double busy_s = 0;
        for (const auto& link : use.links) busy_s = std::max(busy_s, link.busy_s);
        return use.time_s > 0 ? busy_s / use.time_s : 0;
      },
      "share of the time that the busiest direction of a link was busy");
}

}  // namespace observe
