# Layers. Headers are included as "reckon/<layer>/<file>.h"; each layer has an include root of its
# own, a folder that holds nothing but a link to the layer, so that a layer sees only what its
# target links to. Builds that share RECKON_LINKS compile the same command lines, and so share objects.

set(RECKON_LINKS "${PROJECT_BINARY_DIR}/include" CACHE PATH "The folder of these include roots")

function(_reckon_link from to)
  get_filename_component(parent "${to}" DIRECTORY)
  file(MAKE_DIRECTORY "${parent}")
  file(CREATE_LINK "${from}" "${to}" SYMBOLIC)
endfunction()

# reckon_layer(<name> [INSTALL] SEES <targets whose headers it may include, and so may its users>
#              USES <libraries that only its sources see>)
# INSTALL: other projects can have it, as reckon::<name> (see ReckonInstall.cmake).
function(reckon_layer name)
  cmake_parse_arguments(ARG "INSTALL" "" "SEES;USES" ${ARGN})
  set(root "${RECKON_LINKS}/${name}")
  _reckon_link("${PROJECT_SOURCE_DIR}/${name}" "${root}/reckon/${name}")
  file(GLOB sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/${name}/*.cpp")
  list(FILTER sources EXCLUDE REGEX "/main\\.cpp$")
  add_library(reckon_${name} STATIC ${sources})
  target_include_directories(reckon_${name} PUBLIC "$<BUILD_INTERFACE:${root}>")
  target_link_libraries(reckon_${name} PUBLIC ${ARG_SEES} PRIVATE ${ARG_USES})
  if(ARG_INSTALL)
    reckon_install_layer(${name})
  endif()
endfunction()

# reckon_headers(<name> FROM <layer> FILES <headers> SEES <targets>): a few headers of a layer, for a
# layer that may see those types and no more.
function(reckon_headers name)
  cmake_parse_arguments(ARG "" "FROM" "FILES;SEES" ${ARGN})
  set(root "${RECKON_LINKS}/${name}")
  foreach(file IN LISTS ARG_FILES)
    _reckon_link("${PROJECT_SOURCE_DIR}/${ARG_FROM}/${file}" "${root}/reckon/${ARG_FROM}/${file}")
  endforeach()
  add_library(reckon_${name} INTERFACE)
  target_include_directories(reckon_${name} INTERFACE "${root}")
  target_link_libraries(reckon_${name} INTERFACE ${ARG_SEES})
endfunction()
