# Run by ctest with COMPILER, SOURCE and FOLDERS; see must_not_compile.cmake.
string(REPLACE "|" ";" folders "${FOLDERS}")
list(TRANSFORM folders PREPEND "-I")
set(ENV{LC_ALL} C)

file(STRINGS "${SOURCE}" expected LIMIT_COUNT 1)
string(REGEX REPLACE "^// error: " "" expected "${expected}")
set(mode -fsyntax-only)
if(expected MATCHES "No such file")
  set(mode -E -o /dev/null)  # includes are all that matters, and this is quicker
endif()
set(command "${COMPILER}" -std=c++20 ${mode} ${folders} -isystem /usr/include/eigen3)

execute_process(COMMAND ${command} "${SOURCE}" RESULT_VARIABLE failed ERROR_VARIABLE errors)
if(failed)
  message(FATAL_ERROR "${SOURCE} must compile without MUST_NOT_COMPILE:\n${errors}")
endif()
execute_process(COMMAND ${command} -DMUST_NOT_COMPILE "${SOURCE}"
                RESULT_VARIABLE failed ERROR_VARIABLE errors)
if(NOT failed)
  message(FATAL_ERROR "${SOURCE} compiles with MUST_NOT_COMPILE")
endif()
if(NOT errors MATCHES "error: [^\n]*(${expected})")
  message(FATAL_ERROR "${SOURCE} fails with another error than '${expected}':\n${errors}")
endif()
