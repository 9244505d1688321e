# stackabilization_library(NAME SOURCES ... PUBLIC ... PRIVATE ...)
# One static library per module: target stackabilization_NAME, alias stackabilization::NAME.
# Compile options stay private to this project: a consumer inherits include folders and C++20 only.
function(stackabilization_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  set(target stackabilization_${name})
  add_library(${target} STATIC ${ARG_SOURCES})
  add_library(stackabilization::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_include_directories(${target}
    PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>
    PRIVATE ${PROJECT_SOURCE_DIR}/src)
  # Header-only packages are compiled in: consumers of the installed library neither need nor see them. What CGAL's
  # numbers stand on is still linked.
  if("CGAL::CGAL" IN_LIST ARG_PRIVATE)
    list(APPEND ARG_PRIVATE PkgConfig::gmp)
    if(CGAL_VERSION VERSION_GREATER_EQUAL 6)  # which renamed headers that CGAL 5.5 knows by their old names only
      target_compile_definitions(${target} PRIVATE CGAL_NO_DEPRECATION_WARNINGS)
    endif()
  endif()
  list(TRANSFORM ARG_PRIVATE REPLACE "^(CGAL::.*|Boost::boost|nlohmann_json::nlohmann_json)$" "$<BUILD_INTERFACE:\\1>")
  target_link_libraries(${target} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
  stackabilization_options(${target})
  set_property(GLOBAL APPEND PROPERTY STACKABILIZATION_LIBRARIES ${target})
endfunction()

# The library of the address sanitizer, which the Python interpreter loads before a module that is built with it.
if(STACKABILIZATION_SANITIZE MATCHES address)
  set(runtime libasan.so)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    set(runtime libclang_rt.asan-${CMAKE_SYSTEM_PROCESSOR}.so)
  endif()
  execute_process(COMMAND ${CMAKE_CXX_COMPILER} -print-file-name=${runtime}
    OUTPUT_VARIABLE STACKABILIZATION_SANITIZER_RUNTIME OUTPUT_STRIP_TRAILING_WHITESPACE)
endif()

# Warnings and sanitizers of this project's own targets.
function(stackabilization_options target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wshadow -Wnon-virtual-dtor)
  if(CMAKE_UNITY_BUILD AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # It takes sources for headers when they are compiled together.
    target_compile_options(${target} PRIVATE -Wno-subobject-linkage)
  endif()
  if(STACKABILIZATION_BUILD_FUZZERS)
    target_compile_options(${target} PRIVATE -fsanitize=fuzzer-no-link)
  endif()
  if(STACKABILIZATION_SANITIZE)
    target_compile_options(${target} PRIVATE -fsanitize=${STACKABILIZATION_SANITIZE}
      -fno-sanitize-recover=all -fno-omit-frame-pointer)
    target_link_options(${target} PRIVATE -fsanitize=${STACKABILIZATION_SANITIZE})
    # The Python module and the programs share one library. libFuzzer brings its own.
    if(STACKABILIZATION_SANITIZER_RUNTIME AND CMAKE_CXX_COMPILER_ID STREQUAL "Clang"
        AND NOT STACKABILIZATION_BUILD_FUZZERS)
      cmake_path(GET STACKABILIZATION_SANITIZER_RUNTIME PARENT_PATH folder)
      target_link_options(${target} PRIVATE -shared-libsan LINKER:-rpath,${folder})
    endif()
  endif()
endfunction()

# For programs and tests that spend their time in the libraries: a fifth less to compile in a release. With
# -O1, GCC takes some of Eigen's storage for uninitialized.
function(stackabilization_quick_build target)
  target_compile_options(${target} PRIVATE
    $<$<CONFIG:Release>:-O1> $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
endfunction()
