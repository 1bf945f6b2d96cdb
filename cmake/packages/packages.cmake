# Debian packages, one for each installed component: docs/manual/packages.md.
get_cmake_property(CPACK_COMPONENTS_ALL COMPONENTS)
list(REMOVE_ITEM CPACK_COMPONENTS_ALL Unspecified)
set(CPACK_GENERATOR DEB)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_THREADS 0)
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
# The target `packages` builds the packed targets. With makefiles, cpack would build all others too.
set(CPACK_CMAKE_GENERATOR Ninja)

set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
# The packages' maintainer, from the variables that Debian's own tools use.
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "The tlab authors <tlab@users.noreply.invalid>")
if(DEFINED ENV{DEBFULLNAME} AND DEFINED ENV{DEBEMAIL})
  set(CPACK_DEBIAN_PACKAGE_MAINTAINER "$ENV{DEBFULLNAME} <$ENV{DEBEMAIL}>")
endif()
set(full_version ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})

# Without the recommended drawing programs, the command runs and reports the missing plots.
set(CPACK_DEBIAN_TLAB_PACKAGE_NAME tlab)
set(CPACK_DEBIAN_TLAB_PACKAGE_SECTION science)
set(CPACK_DEBIAN_TLAB_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_TLAB_PACKAGE_RECOMMENDS "gnuplot-nox | gnuplot, graphviz")
set(CPACK_DEBIAN_TLAB_PACKAGE_SUGGESTS "libtlab-dev, less, xdg-utils")
set(CPACK_DEBIAN_TLAB_DESCRIPTION "transputer laboratory, a simulator of message-passing machines
The command tlab simulates machines made of transputers, the processors with
four links and a scheduler in microcode that INMOS built for message passing,
while ray-tracing and radiosity programs run on them.

A machine, a topology, a scene and a strategy are described in one file. A run
gives the image, a speed-up curve, and how busy each processor and link was.
The experiments of a thesis of 1995 are included.")

# Libraries that the installed headers include and that cmake/tlabConfig.cmake finds.
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libtlab-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(needed libassimp-dev libboost-context-dev libcairo2-dev libcli11-dev libexpat1-dev libfmt-dev
    libmetis-dev libmuparser-dev libopenexr-dev libpng-dev libsimgrid-dev libtomlplusplus-dev
    libwebp-dev libxxhash-dev nlohmann-json3-dev)
list(JOIN needed ", " CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SUGGESTS "tlab, cmake")
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION "transputer laboratory, libraries for programs of one's own
The simulated machine, its occam vocabulary, topologies, routers, the
renderer and the laboratory as C++20 headers and static libraries, which
CMake's find_package(tlab) finds. The command tlab is not needed to build with them.")

set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-tlab)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS python3-matplotlib)
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${CMAKE_CURRENT_LIST_DIR}/python/postinst
                                              ${CMAKE_CURRENT_LIST_DIR}/python/prerm)
if(python IN_LIST CPACK_COMPONENTS_ALL)
  find_package(Python3 REQUIRED COMPONENTS Interpreter)
  math(EXPR next "${Python3_VERSION_MINOR} + 1")
  set(needed "python3 (>= 3.${Python3_VERSION_MINOR}~)" "python3 (<< 3.${next})"
      "tlab (= ${full_version})" python3-networkx python3-numpy python3-pandas)
  list(JOIN needed ", " CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS)
endif()
set(CPACK_DEBIAN_PYTHON_DESCRIPTION "transputer laboratory, module for Python 3
Runs experiments of tlab from Python: results as pandas tables, topologies to
and from networkx, images as numpy arrays.")

# Adds copyright, changelogs and the list of linked parts; these need the staged files.
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_LIST_DIR}/describe.cmake)
set(CPACK_BUILD_OF_TLAB ${PROJECT_BINARY_DIR})
include(CPack)

add_custom_target(packages COMMAND ${CMAKE_CPACK_COMMAND} WORKING_DIRECTORY ${PROJECT_BINARY_DIR})
add_dependencies(packages tlab completions ${rooms})
foreach(target man tlab_native)  # if their dependencies are installed
  if(TARGET ${target})
    add_dependencies(packages ${target})
  endif()
endforeach()
add_test(NAME Packages.HoldWhatTheyShould
         COMMAND ${PROJECT_SOURCE_DIR}/tests/packages/contents ${PROJECT_BINARY_DIR})
set_tests_properties(Packages.HoldWhatTheyShould PROPERTIES SKIP_RETURN_CODE 77)
