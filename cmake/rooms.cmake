# The rooms of lib/, lowest first, each with the rooms that its files may include from besides its
# own. This is the one place that says so; scripts/check-rooms holds every include against it.
set(VIEWCELL_ROOMS
  "base:"
  "rays: base"
  "image: base"
  "mesh: base rays"
  "gl: base image"
  "formats: base image mesh"
  "uv: base image mesh"
  "pm: base image mesh"
  "adapt: base image mesh gl uv pm"
  "report: base image mesh formats uv"
  "scene: base image mesh formats"
  "import: base image mesh formats scene"
  "cells: base mesh report scene"
  "walk: base rays scene cells"
  "park: base mesh formats pm scene cells"
  "visibility: base rays mesh scene cells"
  "capture: base rays image gl scene cells"
  "bundle: base image scene cells"
  "bake: base image mesh formats pm scene cells visibility capture bundle"
  "draw: base rays image mesh gl report scene"
  "play: base image gl report scene bundle draw")

# Sources that need OpenImageIO are compiled as one, the others as others, VIEWCELL_UNITY_BATCH at a
# time: a program that calls none of the former does not load its 260 libraries, 0.2 s of a start
# (tests/cli/libraries.sh).
set(VIEWCELL_NEEDS_OPENIMAGEIO "^#include [<\"](OpenImageIO/|image/(capture_file|deep_metrics|\
exr_layout|header|index_map|io|jpeg|library|memory_input|picture_size)\\.h|formats/texture(_file|_list|d_obj)\\.h)")
function(viewcell_group_sources TARGET)
  set(n 0)
  foreach(source ${ARGN})
    file(STRINGS ${source} needs REGEX "${VIEWCELL_NEEDS_OPENIMAGEIO}")
    set(group 0)
    if(needs)
      set(group pictures)
    elseif(VIEWCELL_UNITY_BATCH GREATER 0)
      math(EXPR group "${n} / ${VIEWCELL_UNITY_BATCH}")
      math(EXPR n "${n} + 1")
    endif()
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${group})
  endforeach()
  set_target_properties(${TARGET} PROPERTIES UNITY_BUILD_MODE GROUP)
endfunction()

# viewcell_room(NAME [LIBRARIES ...]): the static library viewcell_NAME from lib/NAME/*.cpp, which
# sees the rooms that the table grants it. LIBRARIES are the third-party libraries that only this
# room wraps.
function(viewcell_room NAME)
  cmake_parse_arguments(ARG "" "" "LIBRARIES" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${NAME}/*.cpp)
  add_library(viewcell_${NAME} STATIC ${sources})
  viewcell_group_sources(viewcell_${NAME} ${sources})
  target_include_directories(viewcell_${NAME} PUBLIC ${PROJECT_SOURCE_DIR}/lib)
  set(row ${VIEWCELL_ROOMS})
  list(FILTER row INCLUDE REGEX "^${NAME}:")
  if(NOT row)
    message(FATAL_ERROR "room ${NAME} is not in the table of cmake/rooms.cmake")
  endif()
  string(REGEX REPLACE "^[a-z]+: *" "" needs "${row}")
  string(REPLACE " " ";" needs "${needs}")
  list(TRANSFORM needs PREPEND viewcell_)
  target_link_libraries(viewcell_${NAME} PUBLIC ${needs} PRIVATE ${ARG_LIBRARIES})
endfunction()
