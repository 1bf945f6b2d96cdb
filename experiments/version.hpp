#pragma once

namespace experiments {

constexpr const char* VERSION = TLAB_VERSION;  // the project's, from CMake

}  // namespace experiments
