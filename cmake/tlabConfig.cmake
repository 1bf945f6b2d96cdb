# find_package(tlab): the targets tlab::topologies, tlab::renderer, tlab::machine (the machine and the
# vocabulary) and tlab::simulator (all systems and programs on it), with their dependencies.
include(CMakeFindDependencyMacro)
find_dependency(Boost 1.74 COMPONENTS context filesystem)
find_dependency(PNG)
find_dependency(OpenEXR CONFIG)
find_dependency(fmt)
find_dependency(muparser)
find_dependency(EXPAT)
find_dependency(Threads)
find_library(METIS_LIBRARY metis REQUIRED)
include(${CMAKE_CURRENT_LIST_DIR}/simgrid.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/webp.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/tlabTargets.cmake)
