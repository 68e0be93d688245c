# Language level, warnings and the flags that determinism needs.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()

find_program(RECKON_CCACHE ccache)
if(RECKON_CCACHE)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${RECKON_CCACHE}")
endif()

option(RECKON_SANITIZE "Address and undefined-behaviour sanitizers" OFF)

# -ffp-contract=off: a fused multiply-add in the control law would change the run's bytes.
add_compile_options(-Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Werror
                    -ffp-contract=off)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION MATCHES "^12\\.")
  add_compile_options(-Wno-restrict)  # a false alarm of GCC 12 at `"text" + std::string`
endif()
if(RECKON_SANITIZE)
  # Checks of each pointer's nullness, alignment, size and type triple the time to compile; the address
  # sanitizer and Eigen's assertions see what they would. The sanitizers' own code makes GCC see
  # uninitialised variables in Eigen.
  add_compile_options(-fsanitize=address,undefined -fno-sanitize=null,alignment,object-size,vptr
                      -fno-sanitize-recover=all -fno-omit-frame-pointer -Wno-maybe-uninitialized)
  add_compile_definitions(_GLIBCXX_ASSERTIONS)
  add_link_options(-fsanitize=address,undefined)
endif()
