# evo, run as a program, must find the scores that we find, and h5py must read what we record.
# Both skip (77) where the Python of the tests is absent.
add_executable(reckon_trajectory_errors ground_truth/trajectory_errors.cpp)
target_link_libraries(reckon_trajectory_errors PRIVATE reckon_ground_truth fmt::fmt
                      nlohmann_json::nlohmann_json)
target_include_directories(reckon_trajectory_errors PRIVATE "${CMAKE_CURRENT_SOURCE_DIR}")

add_executable(reckon_sample_recording ground_truth/sample_recording.cpp)
target_link_libraries(reckon_sample_recording PRIVATE reckon_ground_truth)
target_include_directories(reckon_sample_recording PRIVATE "${CMAKE_CURRENT_SOURCE_DIR}")

function(_reckon_python_test name script program)
  add_test(NAME "ground_truth.${name}"
           COMMAND "${CMAKE_CURRENT_SOURCE_DIR}/ground_truth/with_python.sh"
                   "${RECKON_TEST_PYTHON}" "${CMAKE_CURRENT_SOURCE_DIR}/ground_truth/${script}"
                   "$<TARGET_FILE:${program}>")
  set_tests_properties("ground_truth.${name}" PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 300
                       LABELS "${ARGN}")
endfunction()

_reckon_python_test(evo evo_check.py reckon_trajectory_errors slow)
_reckon_python_test(h5py recording_check.py reckon_sample_recording fast)
