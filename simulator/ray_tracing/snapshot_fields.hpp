#pragma once
// Keys of a program's section for recording the picture while it grows.
#include "base/fields.hpp"
#include "renderer/trace/params.hpp"
#include "simulator/snapshots/recorder.hpp"

namespace ray_tracing {

/// show_at_s, show_every_s and growth.
base::Fields<snapshots::Schedule> snapshot_fields();

/// Checks that the recorded pictures fit in the host's memory and in an animation. Else throws
/// base::BadInput that names the key in `section`, such as "farm".
void check_snapshots(const std::string& section, const snapshots::Schedule& snapshot_times,
                     const renderer::Params& image);

}  // namespace ray_tracing
