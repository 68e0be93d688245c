# Run by ctest with BUILD, SOURCE, WORK, COMPILER, LAUNCHER, BUILD_TYPE and FLAGS: installs what BUILD
# has built, moves it away from where it was installed, and lets two projects of somebody else's use
# it, which see neither SOURCE nor BUILD.
cmake_minimum_required(VERSION 3.22)
set(prefix "${WORK}/moved")
set(ENV{LC_ALL} C)

# run(<output variable> <command...>): stdout and stderr; an error where the command fails.
function(run result)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE failed OUTPUT_VARIABLE out ERROR_VARIABLE out)
  if(failed)
    string(JOIN " " command ${ARGN})
    message(FATAL_ERROR "${command}\nfailed: ${failed}\n${out}")
  endif()
  set(${result} "${out}" PARENT_SCOPE)
endfunction()

# Whether `text` names a place of the source or the build outside of this test's own folder.
function(expect_no_source what text)
  string(REPLACE "${WORK}" "" rest "${text}")
  foreach(folder "${SOURCE}" "${BUILD}")
    string(FIND "${rest}" "${folder}/" place)
    if(NOT place EQUAL -1)
      string(SUBSTRING "${rest}" ${place} 200 where)
      message(FATAL_ERROR "${what} names the source or the build: ${where}")
    endif()
  endforeach()
endfunction()

function(expect what text regex)
  if(NOT text MATCHES "${regex}")
    message(FATAL_ERROR "${what} does not match '${regex}':\n${text}")
  endif()
endfunction()

function(install_reckon)
  file(REMOVE_RECURSE "${WORK}")
  run(ignored "${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${WORK}/installed")
  file(RENAME "${WORK}/installed" "${prefix}")
  file(GLOB_RECURSE installed RELATIVE "${prefix}" "${prefix}/*")
  foreach(file IN LISTS installed)
    if(NOT file MATCHES "^include/reckon/(models|estimator)/[a-z0-9_]+\\.h$" AND
       NOT file MATCHES "^lib[^/]*/(.+/)?libreckon_(models|estimator)\\.a$" AND
       NOT file MATCHES "^lib[^/]*/(.+/)?cmake/reckon/reckon-[a-z-]+\\.cmake$")
      message(FATAL_ERROR "${file} is installed, and nobody needs it")
    endif()
    if(file MATCHES "\\.cmake$")
      file(READ "${prefix}/${file}" text)
      expect_no_source("${file}" "${text}")
    endif()
  endforeach()
endfunction()

# Configures and builds the project in SOURCE/<folder>, copied; it finds the package in the prefix alone.
function(build_project folder)
  get_filename_component(name "${folder}" NAME)
  set(project "${WORK}/${name}")
  file(COPY "${SOURCE}/${folder}" DESTINATION "${WORK}")
  run(ignored "${CMAKE_COMMAND}" -S "${project}" -B "${project}/build" -G Ninja
      "-DCMAKE_CXX_COMPILER=${COMPILER}" "-DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER}"
      "-DCMAKE_BUILD_TYPE=${BUILD_TYPE}" "-DCMAKE_CXX_FLAGS=${FLAGS}"
      "-DCMAKE_PREFIX_PATH=${prefix}" -DCMAKE_FIND_USE_PACKAGE_REGISTRY=OFF ${ARGN})
  run(ignored "${CMAKE_COMMAND}" --build "${project}/build")
  # Where its headers came from. A compiler cache may have made the paths relative to the build.
  run(dependencies ninja -C "${project}/build" -t deps)
  string(REGEX MATCHALL "[^ \n]+/reckon/(models|estimator)/[^\n]+" paths "${dependencies}")
  set(headers)
  foreach(path IN LISTS paths)
    get_filename_component(header "${path}" ABSOLUTE BASE_DIR "${project}/build")
    list(APPEND headers "${header}")
  endforeach()
  expect_no_source("a header of ${name}" "${headers}")
  expect("${name}'s headers" "${headers}" "${prefix}/include/reckon/estimator/registry\\.h")
endfunction()

function(check_consumer)
  set(avx2 OFF)
  if(EXISTS /proc/cpuinfo)
    file(STRINGS /proc/cpuinfo avx2 REGEX "^flags.* avx2 " LIMIT_COUNT 1)
  endif()
  if(avx2)
    set(avx2 ON)
  endif()
  build_project(tests/consumer "-DCONSUMER_AVX2=${avx2}")
  # It rolls at 1 m/s by its wheels, and the leg of half a metre points backwards.
  set(expected "speed 1\\.00 1\\.00 m/s, foot -500 0 0 mm\n")
  run(out "${WORK}/consumer/build/consumer")
  expect("the consumer's output" "${out}" "^${expected}$")
  if(avx2)
    run(out "${WORK}/consumer/build/consumer_avx2")
    expect("the output of the consumer with AVX2" "${out}" "^${expected}$")
  endif()
endfunction()

function(check_example)
  build_project(examples/live_filter)
  execute_process(COMMAND "${WORK}/live_filter/build/live_filter"
                  INPUT_FILE "${WORK}/live_filter/input.txt"
                  RESULT_VARIABLE failed OUTPUT_VARIABLE out ERROR_VARIABLE refused)
  if(failed)
    message(FATAL_ERROR "the example fails: ${failed}\n${out}${refused}")
  endif()
  # By hand, for the first velocity along x: the prior's variance and what tilt and accelerometer bias
  # add in 50 ms are P = 0.05² + (0.02·9.81·0.05)² + (0.02·0.05)² = 2.60e-3, the sensor's is 2.50e-3,
  # so that v = 0.05 P/(P + N) = 0.0255 and NIS = 0.05²/(P + N) = 0.490.
  expect("the example's output" "${out}" "^accepted NIS 0\\.49[0-9]* p [^v]* v +0\\.025[0-9]* [^\n]*\n")
  expect("the example's output" "${out}"
         "\nrejected NIS [^\n]*\naccepted NIS [^\n]*\n$")
  expect("what the example refuses" "${refused}"
         "^vel at 0.05 s refused: duplicate\nimu at 0.03 s refused: duplicate\n\
vel at 3 s refused: from_future\nvel at 0.06 s refused: invalid\n$")
endfunction()

install_reckon()
check_consumer()
check_example()
