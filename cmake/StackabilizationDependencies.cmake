# Every package the libraries need, found once. The installed package configuration finds the same ones.
# CMake's own module for Boost is gone since 3.30, also for CGAL's inner search.
set(CMAKE_POLICY_DEFAULT_CMP0167 NEW)
find_package(CGAL 5.5 REQUIRED)
find_package(Eigen3 3.3 REQUIRED NO_MODULE)
include(CGAL_Eigen3_support)
find_package(Boost 1.74 REQUIRED)
find_package(TBB CONFIG REQUIRED)
find_package(pugixml REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(minizip REQUIRED IMPORTED_TARGET minizip)
find_package(ZLIB REQUIRED)
# What CGAL's numbers stand on.
pkg_check_modules(gmp REQUIRED IMPORTED_TARGET gmpxx mpfr gmp)
# tinygltf is header-only and parses with nlohmann-json.
find_package(nlohmann_json 3.9 REQUIRED)

if(STACKABILIZATION_BUILD_RENDERING)
  set(STACKABILIZATION_VTK_COMPONENTS
    CommonCore CommonDataModel FiltersCore IOImage RenderingCore RenderingFreeType RenderingOpenGL2)
  find_package(VTK 9.1 QUIET COMPONENTS ${STACKABILIZATION_VTK_COMPONENTS})
  find_package(OpenGL QUIET COMPONENTS EGL)
  if(NOT VTK_FOUND OR NOT OpenGL_EGL_FOUND)
    message(FATAL_ERROR "Pictures need VTK 9.1 or newer and OpenGL with EGL (Debian: libvtk9-dev, libegl-dev). "
      "To build without them, configure with -DSTACKABILIZATION_BUILD_RENDERING=OFF. ${VTK_NOT_FOUND_MESSAGE}")
  endif()
endif()
if(STACKABILIZATION_BUILD_APPS)
  find_package(CLI11 REQUIRED)
endif()

# The module is for the Python that pybind11 was packaged with, which need not be the first one in the path.
if(STACKABILIZATION_BUILD_PYTHON AND STACKABILIZATION_BUILD_APPS)
  set(PYBIND11_NOPYTHON ON)
  find_package(pybind11 2.10 CONFIG QUIET)
  if(pybind11_FOUND AND NOT DEFINED Python_ROOT_DIR)
    get_filename_component(Python_ROOT_DIR ${pybind11_INCLUDE_DIR} DIRECTORY)
  endif()
  set(Python_FIND_STRATEGY LOCATION)
  set(Python_FIND_UNVERSIONED_NAMES NEVER)
  find_package(Python 3.9 COMPONENTS Interpreter Development.Module NumPy QUIET)
  if(NOT pybind11_FOUND OR NOT Python_FOUND)
    message(STATUS "No Python module: it needs pybind11, NumPy and the headers of Python")
    set(STACKABILIZATION_BUILD_PYTHON OFF)
  endif()
endif()
