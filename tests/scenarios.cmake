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
