# Run by cpack on what it has staged, before it packs: the documents of each package.
foreach(component IN LISTS CPACK_COMPONENTS_ALL)
  string(TOUPPER ${component} name)
  execute_process(COMMAND ${CMAKE_CURRENT_LIST_DIR}/describe ${CPACK_DEBIAN_${name}_PACKAGE_NAME}
                          ${CPACK_PACKAGE_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}
                          ${CPACK_DEBIAN_PACKAGE_MAINTAINER}
                          ${CPACK_TEMPORARY_DIRECTORY}/${component} ${CPACK_BUILD_OF_TLAB}
                  COMMAND_ERROR_IS_FATAL ANY)
endforeach()
