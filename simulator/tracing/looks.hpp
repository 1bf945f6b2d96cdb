#pragma once
// When a picture is looked at while it grows: the keys of a program's section.
#include "base/fields.hpp"
#include "renderer/trace/params.hpp"
#include "simulator/growth/recorder.hpp"

namespace tracing {

/// show_at_s, show_every_s and growth.
base::Fields<growth::Looks> look_fields();

/// What is looked at has to fit in the host's memory, and in a moving picture: else throws
/// base::BadInput, naming the key in `section`, "farm".
void check_looks(const std::string& section, const growth::Looks& looks,
                 const renderer::Params& image);

}  // namespace tracing
