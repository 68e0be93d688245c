# What is installed, used from outside: one test, as the projects need the same installation.
set(flags "${CMAKE_CXX_FLAGS}")
if(RECKON_SANITIZE)
  string(APPEND flags " -fsanitize=address,undefined")
endif()
add_test(NAME estimator.consumer
         COMMAND "${CMAKE_COMMAND}" "-DBUILD=${PROJECT_BINARY_DIR}" "-DSOURCE=${PROJECT_SOURCE_DIR}"
                 "-DWORK=${PROJECT_BINARY_DIR}/consumer" "-DCOMPILER=${CMAKE_CXX_COMPILER}"
                 "-DLAUNCHER=${CMAKE_CXX_COMPILER_LAUNCHER}" "-DBUILD_TYPE=${CMAKE_BUILD_TYPE}"
                 "-DFLAGS=${flags}" -P "${CMAKE_CURRENT_SOURCE_DIR}/consumer/consumer.cmake")
set_tests_properties(estimator.consumer PROPERTIES LABELS fast TIMEOUT 600)
