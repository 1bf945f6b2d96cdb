# find_package(tlab): the targets tlab::topologies, tlab::renderer, tlab::machine (the machine and the
# vocabulary) and tlab::simulator (all systems and programs on it), with their dependencies. With the
# component `laboratory` also tlab::laboratory (the command as a library).
include(CMakeFindDependencyMacro)
find_dependency(Boost 1.74 COMPONENTS context)
find_dependency(PNG)
find_dependency(OpenEXR CONFIG)
find_dependency(fmt)
find_dependency(muparser)
find_dependency(EXPAT)
find_dependency(Threads)
find_library(METIS_LIBRARY metis REQUIRED)
find_library(TOMLPLUSPLUS_LIBRARY tomlplusplus REQUIRED)
if(laboratory IN_LIST tlab_FIND_COMPONENTS)
  find_dependency(CLI11)
  find_dependency(nlohmann_json)
  find_package(assimp QUIET)  # needed if the library was built with it
  find_library(XXHASH_LIBRARY xxhash REQUIRED)
  find_library(CAIRO_LIBRARY cairo REQUIRED)
endif()
include(${CMAKE_CURRENT_LIST_DIR}/simgrid.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/webp.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/tlabTargets.cmake)
set(tlab_laboratory_FOUND TRUE)
