# Code that must not compile. Each source of this folder compiles as it is; with MUST_NOT_COMPILE
# defined it stops compiling, with an error that matches its first line.

# must_not_compile(<layer> <case>...): compiled as a source of that layer, with its include folders.
function(must_not_compile layer)
  set(folders "$<TARGET_PROPERTY:reckon_${layer},INCLUDE_DIRECTORIES>")
  foreach(case IN LISTS ARGN)
    set(test "must_not_compile.${case}")
    add_test(NAME ${test}
             COMMAND ${CMAKE_COMMAND} "-DCOMPILER=${CMAKE_CXX_COMPILER}"
                     "-DSOURCE=${PROJECT_SOURCE_DIR}/tests/must_not_compile/${case}.cpp"
                     "-DFOLDERS=$<JOIN:${folders},|>"
                     -P "${PROJECT_SOURCE_DIR}/tests/must_not_compile/expect_error.cmake")
    set_tests_properties(${test} PROPERTIES LABELS must_not_compile)
  endforeach()
endfunction()

must_not_compile(models models_includes_estimator)
must_not_compile(estimator corrections_of_temporary estimator_includes_harness
                 estimator_includes_recorder estimator_includes_sim estimator_includes_truth)
if(RECKON_WITH_MUJOCO)
  must_not_compile(sim sim_includes_estimate sim_includes_estimator sim_includes_metrics
                   sim_includes_track)
  must_not_compile(ground_truth ground_truth_includes_estimator ground_truth_includes_sim)
  must_not_compile(harness truth_as_measurement truth_as_sample truth_to_estimator)
endif()
