#pragma once
// Keys in a program's section that determine when the growing picture is recorded.
#include "base/fields.hpp"
#include "renderer/trace/params.hpp"
#include "simulator/snapshots/recorder.hpp"

namespace ray_tracing {

/// The fields show_at_s, show_every_s and growth.
base::Fields<snapshots::Schedule> snapshot_fields();

/// Throws base::BadInput unless the recorded pictures fit into the host's memory and into an
/// animation. The error names the key in the section `section`, for instance "farm".
void check_snapshots(const std::string& section, const snapshots::Schedule& snapshot_times,
                     const renderer::Params& image);

}  // namespace ray_tracing
