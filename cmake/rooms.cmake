# The rooms of lib/, lowest first. This is the one place that orders them: a file may include its
# own room and the rooms above it in this list; scripts/check-rooms holds every include against it.
set(VIEWCELL_ROOMS base image mesh pm scene cells visibility gl capture bake play)

# viewcell_room(NAME [LIBRARIES ...]): the static library viewcell_NAME from lib/NAME/*.cpp, which
# sees every lower room. LIBRARIES are the third-party libraries that only this room wraps.
function(viewcell_room NAME)
  cmake_parse_arguments(ARG "" "" "LIBRARIES" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${NAME}/*.cpp)
  if(NOT sources)
    add_library(viewcell_${NAME} INTERFACE)
    set(scope INTERFACE)
    set(private_scope INTERFACE)
  else()
    add_library(viewcell_${NAME} STATIC ${sources})
    set(scope PUBLIC)
    set(private_scope PRIVATE)
  endif()
  target_include_directories(viewcell_${NAME} ${scope} ${PROJECT_SOURCE_DIR}/lib)
  list(FIND VIEWCELL_ROOMS ${NAME} place)
  if(place GREATER 0)
    math(EXPR below "${place} - 1")
    list(GET VIEWCELL_ROOMS ${below} lower)
    target_link_libraries(viewcell_${NAME} ${scope} viewcell_${lower})
  endif()
  target_link_libraries(viewcell_${NAME} ${private_scope} ${ARG_LIBRARIES})
endfunction()
