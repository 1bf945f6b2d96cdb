# Tests and benchmarks, and the packages that only they need.
find_package(GTest REQUIRED)
find_package(embree REQUIRED)  # 3 or 4

enable_testing()
include(GoogleTest)
add_library(tests_support STATIC tests/support/isolated.cpp tests/support/places.cpp)
# Only this file contains the project's path, so that a compiler cache serves every checkout.
set_property(SOURCE tests/support/places.cpp PROPERTY COMPILE_DEFINITIONS
             TLAB_SOURCE_DIR="${PROJECT_SOURCE_DIR}" TLAB_BINARY_DIR="${PROJECT_BINARY_DIR}")
target_link_libraries(tests_support PUBLIC tlab_options GTest::gtest_main)
add_custom_target(tests)
# The tests in tests/NAME and in ALSO, linked only with the libraries in LINKS.
function(add_tests name)
  cmake_parse_arguments(TESTS "" "" "ALSO;LINKS" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS tests/${name}/*.cpp)
  list(APPEND sources ${TESTS_ALSO})
  add_executable(tests_${name} ${sources})
  target_link_libraries(tests_${name} PRIVATE ${TESTS_LINKS} tests_support)
  target_compile_options(tests_${name} PRIVATE ${sooner})
  gtest_discover_tests(tests_${name} DISCOVERY_TIMEOUT 60)
  add_dependencies(tests tests_${name})
endfunction()

# The reference path tracer for radiosity's pictures, and its command: tests/reference/run.
file(GLOB reference_sources CONFIGURE_DEPENDS tests/reference/*.cpp)
list(FILTER reference_sources EXCLUDE REGEX "/main.cpp$")
add_library(tests_reference STATIC ${reference_sources})
target_link_libraries(tests_reference PUBLIC renderer PRIVATE embree)
add_executable(reference tests/reference/main.cpp)
target_link_libraries(reference PRIVATE tests_reference experiments_laboratory_command)
target_compile_options(reference PRIVATE ${sooner})
add_dependencies(tests reference)

# Fuzz tests of the file readers with almost valid texts, and their command: tests/fuzz/run.
file(GLOB fuzz_sources CONFIGURE_DEPENDS tests/fuzz/*.cpp)
list(FILTER fuzz_sources EXCLUDE REGEX "/main.cpp$|_test.cpp$")
add_library(tests_fuzz STATIC ${fuzz_sources})
target_link_libraries(tests_fuzz PUBLIC experiments_laboratory_command)
target_compile_options(tests_fuzz PRIVATE ${sooner})
set_property(SOURCE tests/fuzz/readers.cpp PROPERTY COMPILE_DEFINITIONS
             TLAB_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
add_executable(fuzz tests/fuzz/main.cpp)
target_link_libraries(fuzz PRIVATE tests_fuzz)
target_compile_options(fuzz PRIVATE ${sooner})
target_link_options(fuzz PRIVATE -Wl,-z,now)  # binds symbols once instead of in each child
add_dependencies(fuzz tlab)
add_dependencies(tests fuzz)
foreach(reader nff path room nff-room obj obj-room mtl picture state dot graphml routes csv formula expression
        toml experiment override)
  add_test(NAME Fuzz.${reader} COMMAND fuzz --reader ${reader} --cases 1000)
endforeach()
foreach(reader model record run simulation reference)  # slower cases
  add_test(NAME Fuzz.${reader} COMMAND fuzz --reader ${reader} --cases 200)
endforeach()

add_test(NAME Fuzz.command COMMAND fuzz --command --cases 30)

add_tests(base ALSO tests/include_graph_test.cpp tests/support/isolated_test.cpp LINKS base)
add_tests(topologies LINKS topologies)
add_tests(renderer LINKS renderer renderer_meshes tests_reference OpenEXR::OpenEXR tlab::webpdemux)
add_tests(simulator LINKS simulator)
# The tests of the machine and of occam again: with our own links, and with processes on SimGrid's
# actors. The address sanitizer does not know the actors' stacks.
string(JOIN ":" tests_of_machine Alt* CaseOf* Deadlock* Dma* Each* Engine.* FailureDeadlock* Forecast*
       HardRendezvous* Link* Machine* Observer* Par.* Proc* Random* Run.* Scheduler*
       SoftRendezvous* TimeSlices* Timeout* Timer* VariantProtocol*)
foreach(engine direct actors)
  if(engine STREQUAL direct OR NOT CMAKE_CXX_FLAGS MATCHES "sanitize")
    add_test(NAME Machine.${engine}
             COMMAND tests_simulator --gtest_brief=1 --gtest_filter=${tests_of_machine})
    set_tests_properties(Machine.${engine} PROPERTIES ENVIRONMENT TLAB_TEST_ENGINE=${engine})
  endif()
endforeach()
add_test(NAME Machine.procs COMMAND tests_simulator --gtest_brief=1
                                    --gtest_filter=AltFailure*:Link*:FailureDeadlock*)
set_tests_properties(Machine.procs PROPERTIES ENVIRONMENT TLAB_TEST_BODIES=procs)
add_test(NAME Reference.ComparesARandomRoom
         COMMAND reference --seeds 5-5 --size 24x18 --paths 16 --creases none)
add_tests(laboratory ALSO tests/fuzz/campaign_test.cpp LINKS tests_fuzz tlab::webpdemux)
add_dependencies(tests_laboratory tlab ${examples})
add_test(NAME Report.WorksInABrowser
         COMMAND ${PROJECT_SOURCE_DIR}/tests/laboratory/report/browser_trial $<TARGET_FILE:tlab>)
add_test(NAME Live.WorksInABrowser
         COMMAND ${PROJECT_SOURCE_DIR}/tests/laboratory/live/browser_trial $<TARGET_FILE:tlab>)
set_tests_properties(Report.WorksInABrowser Live.WorksInABrowser
                     PROPERTIES SKIP_RETURN_CODE 77)

# Benchmarks: speed as ratios against peers in the same run: tests/benchmarks/run.
if(TLAB_BENCHMARKS)
  find_package(benchmark REQUIRED)
  file(GLOB benchmark_sources CONFIGURE_DEPENDS tests/benchmarks/*.cpp)
  add_executable(benchmarks ${benchmark_sources})
  set_target_properties(benchmarks PROPERTIES UNITY_BUILD OFF)  # sources share private names
  target_link_libraries(benchmarks PRIVATE simulator benchmark::benchmark embree ${SIMGRID_LIBRARY})
endif()

add_test(NAME Install.AUsersProjectLinksAndRuns
         COMMAND ${PROJECT_SOURCE_DIR}/tests/consumer/run ${PROJECT_BINARY_DIR})
add_test(NAME Routers.SpinFindsOnlyTheNaiveRoutersDeadlock
         COMMAND ${PROJECT_SOURCE_DIR}/tests/simulator/promela/run --short routers)
add_test(NAME Termination.SpinFindsOnlyWrongWaysWrong
         COMMAND ${PROJECT_SOURCE_DIR}/tests/simulator/promela/run --short termination)
set_tests_properties(Routers.SpinFindsOnlyTheNaiveRoutersDeadlock
                     Termination.SpinFindsOnlyWrongWaysWrong PROPERTIES SKIP_RETURN_CODE 77)

# Fewer kills than the default of `tests/kills/run`, each followed by a resumed run.
add_test(NAME Kills.LoseNothingAndLeaveNothing
         COMMAND ${PROJECT_SOURCE_DIR}/tests/kills/run --number 50 $<TARGET_FILE:tlab>)

# Tests of the Python package, its notebooks and its documentation.
if(TARGET tlab_native)
  add_dependencies(tests tlab_native)
endif()
file(GLOB python_tests CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR}/tests/python
     tests/python/*_test.py)
foreach(file IN LISTS python_tests)
  string(REPLACE "_test.py" "" name ${file})
  add_test(NAME Python.${name} COMMAND ${PROJECT_SOURCE_DIR}/tests/python/run ${file}
           ${PROJECT_BINARY_DIR})
  set_tests_properties(Python.${name} PROPERTIES SKIP_RETURN_CODE 77)
endforeach()

# The manual's examples; docs/generate shows them with their output. The test checks that the
# manual's generated parts are up to date with this build.
foreach(example ladder operation barrier)
  add_executable(docs_${example} docs/examples/${example}.cpp)
  target_link_libraries(docs_${example} PRIVATE simulator)
  add_dependencies(tests docs_${example})
endforeach()
target_sources(docs_barrier PRIVATE docs/examples/run_barrier.cpp)
add_test(NAME Docs.GeneratedPagesAreUpToDate
         COMMAND ${PROJECT_SOURCE_DIR}/docs/generate --check $<TARGET_FILE:tlab>)
add_test(NAME Docs.LinksAndSearch COMMAND ${PROJECT_SOURCE_DIR}/docs/check)

# The manual's tutorials, command by command; those of the second loop use the installed library.
foreach(page lecture topology board)
  add_test(NAME Tutorials.${page}
           COMMAND ${PROJECT_SOURCE_DIR}/tests/tutorials/run
                   ${PROJECT_SOURCE_DIR}/docs/manual/tutorial-${page}.md $<TARGET_FILE:tlab>)
endforeach()
foreach(page tutorial-program own-laboratory)
  string(REPLACE "tutorial-" "" name ${page})
  add_test(NAME Tutorials.${name}
           COMMAND ${PROJECT_SOURCE_DIR}/tests/tutorials/run
                   ${PROJECT_SOURCE_DIR}/docs/manual/${page}.md --install ${PROJECT_BINARY_DIR})
endforeach()
set_tests_properties(Tutorials.lecture Tutorials.topology Tutorials.board Tutorials.program
                     Tutorials.own-laboratory
                     PROPERTIES SKIP_RETURN_CODE 77)

# Starts the longest tests first, so that none of them runs alone at the end.
set_tests_properties(Live.WorksInABrowser Report.WorksInABrowser Python.notebooks
                     Routers.SpinFindsOnlyTheNaiveRoutersDeadlock
                     Termination.SpinFindsOnlyWrongWaysWrong Kills.LoseNothingAndLeaveNothing
                     PROPERTIES COST 100)
