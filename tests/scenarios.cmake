# Every scenario that has an `expect:` is a test of its own, named after its path.
file(GLOB_RECURSE scenarios RELATIVE "${PROJECT_SOURCE_DIR}/scenarios" CONFIGURE_DEPENDS
     "${PROJECT_SOURCE_DIR}/scenarios/*.yaml")
foreach(scenario IN LISTS scenarios)
  set(file "${PROJECT_SOURCE_DIR}/scenarios/${scenario}")
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${file}")
  file(STRINGS "${file}" expects REGEX "^expect:")
  if(expects)
    string(REGEX REPLACE "\\.yaml$" "" name "${scenario}")
    add_test(NAME "scenario.${name}"
             COMMAND reckon run "${file}" --out "${PROJECT_BINARY_DIR}/scenario_results" --quiet)
    set_tests_properties("scenario.${name}" PROPERTIES LABELS scenario TIMEOUT 600
                         SKIP_RETURN_CODE 77)
  endif()
endforeach()

# And every scenario of ours fails when something is broken on purpose: the lines of mutations.txt.
set(mutations "${CMAKE_CURRENT_SOURCE_DIR}/mutations.txt")
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${mutations}")
file(READ "${mutations}" lines)
string(REPLACE ";" "\\;" lines "${lines}")
string(REGEX MATCHALL "[^\n]+" lines "${lines}")
foreach(line IN LISTS lines)
  if(line MATCHES "^([a-z_/0-9]+) \\| ([a-z_0-9]+) \\| (.*)$")
    add_test(NAME "scenario.${CMAKE_MATCH_1}.fails_with.${CMAKE_MATCH_2}"
             COMMAND "${CMAKE_COMMAND}" -DCODE=1 "-DPROGRAM=$<TARGET_FILE:reckon>"
                     "-DSCENARIO=${PROJECT_SOURCE_DIR}/scenarios/${CMAKE_MATCH_1}.yaml"
                     "-DARGUMENTS=${CMAKE_MATCH_3}"
                     "-DOUT=${PROJECT_BINARY_DIR}/scenario_results/mutated"
                     -P "${CMAKE_CURRENT_SOURCE_DIR}/mutation.cmake")
    set_tests_properties("scenario.${CMAKE_MATCH_1}.fails_with.${CMAKE_MATCH_2}"
                         PROPERTIES LABELS scenario TIMEOUT 600)
  endif()
endforeach()
