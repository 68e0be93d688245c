# MuJoCo 4.0.1 as the imported target mujoco::mujoco: an existing target, then find_package, then the
# wheel that pip fetches (checked by its hash) into a cache outside the build folder.
set(RECKON_MUJOCO_VERSION 4.0.1)

function(_reckon_mujoco_from_wheel)
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(aarch64|arm64)$")
    set(arch aarch64)
    set(sha256 52d934614a56f7d75dcfc2bd8bb72f058b465ecc19a0583a56df242f9505bdb6)
  else()
    set(arch x86_64)
    set(sha256 be28c0c7587347ef996b4de0487264e9da296282082b092bae211a9163e9aed6)
  endif()
  if(DEFINED ENV{XDG_CACHE_HOME})
    set(cache "$ENV{XDG_CACHE_HOME}/reckon")
  else()
    set(cache "$ENV{HOME}/.cache/reckon")
  endif()
  set(folder "${cache}/mujoco-${RECKON_MUJOCO_VERSION}-${arch}")
  file(MAKE_DIRECTORY "${cache}")
  file(LOCK "${cache}/mujoco.lock" GUARD FUNCTION TIMEOUT 600)

  file(GLOB wheels "${folder}/*.whl")
  if(NOT wheels)
    find_package(Python3 REQUIRED COMPONENTS Interpreter)
    file(MAKE_DIRECTORY "${folder}")
    file(WRITE "${folder}/requirements.txt"
         "mujoco-core==${RECKON_MUJOCO_VERSION} --hash=sha256:${sha256}\n")
    execute_process(
      COMMAND "${Python3_EXECUTABLE}" -m pip download --quiet --no-deps --only-binary=:all:
              --python-version=3.11 --implementation=cp --abi=cp311
              "--platform=manylinux_2_28_${arch}" --require-hashes
              -r "${folder}/requirements.txt" -d "${folder}"
      RESULT_VARIABLE failed)
    if(failed)
      message(FATAL_ERROR "pip could not fetch mujoco-core ${RECKON_MUJOCO_VERSION}")
    endif()
    file(GLOB wheels "${folder}/*.whl")
  endif()
  list(GET wheels 0 wheel)
  file(SHA256 "${wheel}" actual)
  if(NOT actual STREQUAL sha256)
    message(FATAL_ERROR "${wheel} has the wrong hash ${actual}; remove it and configure again")
  endif()
  set(library "${folder}/mujoco/libmujoco.so.${RECKON_MUJOCO_VERSION}")
  if(NOT EXISTS "${library}")
    file(ARCHIVE_EXTRACT INPUT "${wheel}" DESTINATION "${folder}"
         PATTERNS "mujoco/libmujoco.so.*" "mujoco/include/*" "*LICENSE*")
  endif()

  add_library(mujoco::mujoco SHARED IMPORTED GLOBAL)
  set_target_properties(mujoco::mujoco PROPERTIES
    IMPORTED_LOCATION "${library}"
    INTERFACE_INCLUDE_DIRECTORIES "${folder}/mujoco/include"
    INTERFACE_SYSTEM_INCLUDE_DIRECTORIES "${folder}/mujoco/include")
endfunction()

if(NOT TARGET mujoco::mujoco)
  find_package(mujoco ${RECKON_MUJOCO_VERSION} EXACT QUIET)
endif()
if(NOT TARGET mujoco::mujoco)
  _reckon_mujoco_from_wheel()
endif()
