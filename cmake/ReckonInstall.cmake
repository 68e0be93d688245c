# The package that other projects find: find_package(reckon 0.1), then reckon::estimator. It holds the
# layers that run on a robot, nothing of the simulator and no robot's files.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
include(CheckCXXSourceCompiles)
set(RECKON_PACKAGE_DIR "${CMAKE_INSTALL_LIBDIR}/cmake/reckon")

# _reckon_compiles(<variable> <source>): with the flags of this build, which may have changed.
function(_reckon_compiles variable source)
  set(CMAKE_REQUIRED_LIBRARIES Eigen3::Eigen)
  set(CMAKE_REQUIRED_QUIET ON)
  set(CMAKE_TRY_COMPILE_CONFIGURATION "${CMAKE_BUILD_TYPE}")
  set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
  unset(${variable} CACHE)
  check_cxx_source_compiles("${source}" ${variable})
endfunction()

# What the layers hold must lie in a user's memory as it does in theirs. -mavx or -march=native changes
# that, on either side, so that users are told of this build how Eigen aligns [bytes] and whether a lane
# is a register of AVX2.
function(_reckon_layout alignment lanes)
  _reckon_compiles(RECKON_HAS_AVX2 "#ifndef __AVX2__\n#error no\n#endif")
  set(${lanes} 0 PARENT_SCOPE)
  if(RECKON_HAS_AVX2)
    set(${lanes} 1 PARENT_SCOPE)
  endif()
  foreach(bytes 16 32 64)
    _reckon_compiles(RECKON_ALIGNS_TO_${bytes}
      "#include <Eigen/Core>\nstatic_assert(EIGEN_MAX_STATIC_ALIGN_BYTES == ${bytes});")
    if(RECKON_ALIGNS_TO_${bytes})
      set(${alignment} ${bytes} PARENT_SCOPE)
      return()
    endif()
  endforeach()
  message(FATAL_ERROR "Eigen aligns to neither 16, 32 nor 64 bytes here")
endfunction()

# reckon_install_layer(<name>): the layer's library and headers.
function(reckon_install_layer name)
  file(GLOB headers CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/${name}/*.h")
  set_target_properties(reckon_${name} PROPERTIES EXPORT_NAME ${name})
  target_compile_features(reckon_${name} PUBLIC cxx_std_20)
  install(TARGETS reckon_${name} EXPORT reckon
          ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}"
          INCLUDES DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
  install(FILES ${headers} DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/reckon/${name}")
endfunction()

# reckon_install_package(): what find_package needs, once the layers are there.
function(reckon_install_package)
  _reckon_layout(bytes lanes)
  target_compile_definitions(reckon_models INTERFACE
    "$<INSTALL_INTERFACE:EIGEN_MAX_STATIC_ALIGN_BYTES=${bytes};RECKON_AVX2_LANES=${lanes}>")
  configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/reckon-config.cmake.in"
    "${PROJECT_BINARY_DIR}/reckon-config.cmake" INSTALL_DESTINATION "${RECKON_PACKAGE_DIR}"
    NO_SET_AND_CHECK_MACRO)
  # Before version 1.0 a minor version may break its users.
  write_basic_package_version_file("${PROJECT_BINARY_DIR}/reckon-config-version.cmake"
                                   COMPATIBILITY SameMinorVersion)
  install(EXPORT reckon NAMESPACE reckon:: FILE reckon-targets.cmake
          DESTINATION "${RECKON_PACKAGE_DIR}")
  install(FILES "${PROJECT_BINARY_DIR}/reckon-config.cmake"
                "${PROJECT_BINARY_DIR}/reckon-config-version.cmake"
          DESTINATION "${RECKON_PACKAGE_DIR}")
endfunction()
