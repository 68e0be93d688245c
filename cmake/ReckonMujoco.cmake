# MuJoCo 4.0.1 as the imported target mujoco::mujoco: an existing target, then find_package, then the
# wheel that pip fetches, checked by its hash, into a cache outside the build folder. Whatever lies in
# the cache under a final name is whole: it is fetched and unpacked beside it, then renamed.
set(RECKON_MUJOCO_VERSION 4.0.1)

function(_reckon_mujoco_cache result)
  if(NOT "$ENV{XDG_CACHE_HOME}" STREQUAL "")
    set(${result} "$ENV{XDG_CACHE_HOME}/reckon" PARENT_SCOPE)
  else()
    set(${result} "$ENV{HOME}/.cache/reckon" PARENT_SCOPE)
  endif()
endfunction()

# The first Python that has pip: Debian's own before whatever comes first in PATH.
function(_reckon_python_with_pip result)
  find_program(RECKON_PATH_PYTHON NAMES python3)
  foreach(python /usr/bin/python3 "${RECKON_PATH_PYTHON}")
    execute_process(COMMAND "${python}" -m pip --version RESULT_VARIABLE failed
                    OUTPUT_QUIET ERROR_QUIET)
    if(NOT failed)
      set(${result} "${python}" PARENT_SCOPE)
      return()
    endif()
  endforeach()
  message(FATAL_ERROR "MuJoCo comes as a Python wheel, and no python3 here has pip (python3-pip)")
endfunction()

function(_reckon_fetch_wheel wheel arch sha256)
  set(part "${wheel}.part")
  file(REMOVE_RECURSE "${part}")
  file(WRITE "${part}/requirements.txt"
       "mujoco-core==${RECKON_MUJOCO_VERSION} --hash=sha256:${sha256}\n")
  _reckon_python_with_pip(python)
  message(STATUS "Fetching MuJoCo ${RECKON_MUJOCO_VERSION}")
  # The library is the same in the wheels of every Python, so one of them serves all.
  execute_process(
    COMMAND "${python}" -m pip download --quiet --no-deps --only-binary=:all: --python-version=3.11
            --implementation=cp --abi=cp311 "--platform=manylinux_2_28_${arch}" --require-hashes
            -r "${part}/requirements.txt" -d "${part}"
    RESULT_VARIABLE failed)
  file(GLOB fetched "${part}/*.whl")
  if(failed OR NOT fetched)
    message(FATAL_ERROR "pip could not fetch mujoco-core ${RECKON_MUJOCO_VERSION}; with no network, "
                        "copy ${wheel} from a machine that has it")
  endif()
  file(RENAME "${fetched}" "${wheel}")
  file(REMOVE_RECURSE "${part}")
endfunction()

function(_reckon_mujoco_from_wheel)
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(aarch64|arm64)$")
    set(arch aarch64)
    set(sha256 52d934614a56f7d75dcfc2bd8bb72f058b465ecc19a0583a56df242f9505bdb6)
  else()
    set(arch x86_64)
    set(sha256 be28c0c7587347ef996b4de0487264e9da296282082b092bae211a9163e9aed6)
  endif()
  _reckon_mujoco_cache(cache)
  set(folder "${cache}/mujoco-${RECKON_MUJOCO_VERSION}-${arch}")
  set(library "${folder}/mujoco/libmujoco.so.${RECKON_MUJOCO_VERSION}")
  set(wheel "${folder}.whl")
  file(MAKE_DIRECTORY "${cache}")
  file(LOCK "${folder}.lock" GUARD FUNCTION TIMEOUT 600)
  if(NOT EXISTS "${library}")
    set(actual "")
    if(EXISTS "${wheel}")
      file(SHA256 "${wheel}" actual)
    endif()
    if(NOT actual STREQUAL sha256)
      _reckon_fetch_wheel("${wheel}" ${arch} ${sha256})
    endif()
    file(REMOVE_RECURSE "${folder}" "${folder}.part")
    file(ARCHIVE_EXTRACT INPUT "${wheel}" DESTINATION "${folder}.part"
         PATTERNS "mujoco/libmujoco.so.*" "mujoco/include/*" "*LICENSE*")
    file(RENAME "${folder}.part" "${folder}")
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
