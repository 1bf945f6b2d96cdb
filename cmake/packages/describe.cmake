# Makes the documents of all packages. cpack runs this file on the staged files before it packs them.
set(staged "")
foreach(component IN LISTS CPACK_COMPONENTS_ALL)
  string(TOUPPER ${component} name)
  list(APPEND staged ${CPACK_DEBIAN_${name}_PACKAGE_NAME} ${CPACK_TEMPORARY_DIRECTORY}/${component})
endforeach()
execute_process(COMMAND ${CMAKE_CURRENT_LIST_DIR}/describe
                        ${CPACK_PACKAGE_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}
                        ${CPACK_DEBIAN_PACKAGE_MAINTAINER} ${CPACK_BUILD_OF_TLAB} ${staged}
                COMMAND_ERROR_IS_FATAL ANY)
