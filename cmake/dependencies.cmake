# The libraries, each with the Debian 12 package that brings it: what is missing is said by the name
# that it is installed by. scripts/install-deps installs all of them.
function(viewcell_missing PACKAGE WHAT)
  message(FATAL_ERROR "${WHAT} is missing: Debian's package ${PACKAGE} has it; "
    "scripts/install-deps installs all that is needed")
endfunction()

# viewcell_need_package(PACKAGE NAME [VERSION]): find_package.
macro(viewcell_need_package PACKAGE NAME)
  find_package(${NAME} ${ARGN} QUIET)
  if(NOT ${NAME}_FOUND)
    viewcell_missing(${PACKAGE} ${NAME})
  endif()
endmacro()

# viewcell_need_header(PACKAGE HEADER): a header on the compiler's own path.
function(viewcell_need_header PACKAGE HEADER)
  string(MAKE_C_IDENTIFIER "HAS_${HEADER}" variable)
  find_path(${variable} ${HEADER})
  mark_as_advanced(${variable})
  if(NOT ${variable})
    viewcell_missing(${PACKAGE} ${HEADER})
  endif()
endfunction()

find_package(Threads REQUIRED)
viewcell_need_package(pkgconf PkgConfig)
# OpenImageIO by pkg-config: its CMake targets in Debian name programs and OpenCV headers of packages
# that nothing here needs.
pkg_check_modules(OpenImageIO QUIET IMPORTED_TARGET OpenImageIO)
if(NOT OpenImageIO_FOUND)
  viewcell_missing(libopenimageio-dev OpenImageIO)
endif()
pkg_check_modules(WebP QUIET IMPORTED_TARGET libwebp libwebpdemux)
if(NOT WebP_FOUND)
  viewcell_missing(libwebp-dev WebP)
endif()
viewcell_need_package(libembree-dev embree 3)
viewcell_need_package(libcli11-dev CLI11)
viewcell_need_package(nlohmann-json3-dev nlohmann_json)
viewcell_need_package(libmeshoptimizer-dev meshoptimizer)
viewcell_need_package(libdraco-dev draco)
viewcell_need_package(zlib1g-dev ZLIB)
viewcell_need_package(libeigen3-dev Eigen3)
viewcell_need_package(libopenmesh-dev OpenMesh)
viewcell_need_header(libglm-dev glm/glm.hpp)
viewcell_need_header(libimath-dev Imath/half.h)
viewcell_need_header(libstb-dev stb/stb_dxt.h)
viewcell_need_header(libxxhash-dev xxhash.h)
find_library(XXHASH_LIBRARY xxhash REQUIRED)
# Their functions are found at run time; these are declarations.
viewcell_need_header(libgl-dev GL/glcorearb.h)
viewcell_need_header(libosmesa6-dev GL/osmesa.h)
viewcell_need_header(libegl-dev EGL/eglext.h)
if(VIEWCELL_TESTS)
  viewcell_need_package(libgtest-dev GTest)
  viewcell_need_package(libbenchmark-dev benchmark)
endif()
