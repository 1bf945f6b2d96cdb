# Builds the Python package. It consists of Python modules and of the extension tlab._native, which is linked
# from the C++ modules. The build tree has the package in python/, beside the command that the package starts.
# The Python modules there are links to the sources.
set_target_properties(experiments_python_bindings PROPERTIES CXX_VISIBILITY_PRESET hidden)
pybind11_add_module(tlab_native MODULE NO_EXTRAS ${PROJECT_SOURCE_DIR}/experiments/python/bindings/main.cpp)
target_link_libraries(tlab_native PRIVATE experiments_python_bindings)
target_compile_definitions(tlab_native PRIVATE TLAB_VERSION="${PROJECT_VERSION}")
set(package ${PROJECT_BINARY_DIR}/python/tlab)
set_target_properties(tlab_native PROPERTIES OUTPUT_NAME _native
                      LIBRARY_OUTPUT_DIRECTORY ${package})
file(MAKE_DIRECTORY ${package})
file(GLOB modules CONFIGURE_DEPENDS experiments/python/tlab/*.py)
foreach(module IN LISTS modules)
  get_filename_component(name ${module} NAME)
  file(CREATE_LINK ${module} ${package}/${name} SYMBOLIC)
endforeach()

set(TLAB_PYTHON_DIR lib/python3/dist-packages CACHE STRING
    "Where the package is installed; with the prefix /usr Debian's Python finds it there")
install(TARGETS tlab_native LIBRARY DESTINATION ${TLAB_PYTHON_DIR}/tlab COMPONENT python OPTIONAL)
install(FILES ${modules} DESTINATION ${TLAB_PYTHON_DIR}/tlab COMPONENT python)
install(DIRECTORY experiments/notebooks DESTINATION share/tlab COMPONENT python
        FILES_MATCHING PATTERN "*.ipynb")
