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
    if(name MATCHES "^logs/")
      set_tests_properties("scenario.${name}" PROPERTIES FIXTURES_REQUIRED "log_${name}")
    endif()
  endif()
endforeach()

# The log that is not ours to keep: made from where it lies, beside the sources or wherever
# RECKON_HOLOOCEAN_LOG says, and skipped where it is not.
set(RECKON_HOLOOCEAN_LOG "${PROJECT_SOURCE_DIR}/../shared/data/auv_holoocean/log.txt" CACHE FILEPATH
    "The published log that examples/holoocean_log/convert.py reads")
add_test(NAME logs.holoocean_auv
         COMMAND "${CMAKE_COMMAND}" -DPYTHON=${RECKON_PYTHON} "-DLOG=${RECKON_HOLOOCEAN_LOG}"
                 "-DCONVERT=${PROJECT_SOURCE_DIR}/examples/holoocean_log/convert.py"
                 "-DFOLDER=${PROJECT_SOURCE_DIR}/out/logs/holoocean_auv"
                 -P "${CMAKE_CURRENT_SOURCE_DIR}/convert_log.cmake")
set_tests_properties(logs.holoocean_auv PROPERTIES LABELS scenario
                     FIXTURES_SETUP "log_logs/holoocean_auv")

# And every scenario of ours fails when something is broken on purpose: the lines of mutations.txt.
set(mutations "${CMAKE_CURRENT_SOURCE_DIR}/mutations.txt")
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${mutations}")
file(READ "${mutations}" lines)
string(REPLACE ";" "\\;" lines "${lines}")
string(REGEX MATCHALL "[^\n]+" lines "${lines}")
foreach(line IN LISTS lines)
  if(line MATCHES "^([a-z_/0-9]+) \\| ([a-z_0-9]+) \\| (.*)$")
    set(scenario "${CMAKE_MATCH_1}")
    set(test "scenario.${scenario}.fails_with.${CMAKE_MATCH_2}")
    add_test(NAME "${test}"
             COMMAND "${CMAKE_COMMAND}" -DCODE=1 "-DPROGRAM=$<TARGET_FILE:reckon>"
                     "-DSCENARIO=${PROJECT_SOURCE_DIR}/scenarios/${scenario}.yaml"
                     "-DARGUMENTS=${CMAKE_MATCH_3}"
                     "-DOUT=${PROJECT_BINARY_DIR}/scenario_results/mutated"
                     -P "${CMAKE_CURRENT_SOURCE_DIR}/mutation.cmake")
    set_tests_properties("${test}" PROPERTIES LABELS scenario TIMEOUT 600
                         SKIP_REGULAR_EXPRESSION "skipped: there is no log")
    if(scenario MATCHES "^logs/")
      set_tests_properties("${test}" PROPERTIES FIXTURES_REQUIRED "log_${scenario}")
    endif()
  endif()
endforeach()
