# SimGrid as a target; Debian's package has no CMake configuration.
find_library(SIMGRID_LIBRARY simgrid REQUIRED)
if(NOT TARGET tlab::simgrid)
  add_library(tlab::simgrid UNKNOWN IMPORTED GLOBAL)
  set_target_properties(tlab::simgrid PROPERTIES IMPORTED_LOCATION ${SIMGRID_LIBRARY})
endif()
