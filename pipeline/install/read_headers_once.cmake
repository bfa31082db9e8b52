# What nearly every file includes is read once, not once a file: for the programs, for libraries whose loops count, as
# GCC keeps the level of optimisation in what it has read, and for the tests. Not read with it: targets that
# have DISABLE_PRECOMPILE_HEADERS for flags of their own, and sources with OTHER_EIGEN (rooms_as_units).
option(MAMMOTWIN_READ_HEADERS_ONCE "precompile the headers that nearly every file includes" ON)
if(NOT MAMMOTWIN_READ_HEADERS_ONCE)
  return()
endif()

find_package(nlohmann_json REQUIRED)
set(nothing ${CMAKE_BINARY_DIR}/generated/nothing.cpp)
file(CONFIGURE OUTPUT ${nothing} CONTENT "")

function(common_headers name)
  add_library(${name} OBJECT ${nothing})
  target_link_libraries(${name} PRIVATE Eigen3::Eigen nlohmann_json::nlohmann_json)
  target_precompile_headers(${name} PRIVATE
    <algorithm> <array> <cmath> <cstdint> <filesystem> <fstream> <functional> <limits> <map> <memory> <numbers>
    <numeric> <optional> <random> <set> <sstream> <stdexcept> <string> <utility> <vector>
    <Eigen/Cholesky> <Eigen/Core> <Eigen/Eigenvalues> <Eigen/Geometry> <Eigen/LU>
    <nlohmann/json.hpp> <tbb/parallel_for.h>)
endfunction()

common_headers(headers_of_programs)
common_headers(headers_of_loops)
loops_count(headers_of_loops)
if(MAMMOTWIN_TESTS)
  find_package(GTest REQUIRED)
  common_headers(headers_of_tests)
  target_link_libraries(headers_of_tests PRIVATE GTest::gtest)
  target_precompile_headers(headers_of_tests PRIVATE <gtest/gtest.h>)
endif()

function(read_headers_once folder)
  get_directory_property(targets DIRECTORY ${folder} BUILDSYSTEM_TARGETS)
  foreach(target ${targets})
    get_target_property(type ${target} TYPE)
    get_target_property(loops ${target} LOOPS_COUNT)
    get_target_property(libraries ${target} LINK_LIBRARIES)
    if(NOT type MATCHES "^(STATIC_LIBRARY|EXECUTABLE)$")
      continue()
    elseif(loops)
      set(headers headers_of_loops)
    elseif("GTest::gtest_main" IN_LIST libraries)
      set(headers headers_of_tests)
    else()
      set(headers headers_of_programs)
    endif()
    target_precompile_headers(${target} REUSE_FROM ${headers})
  endforeach()
  get_directory_property(subfolders DIRECTORY ${folder} SUBDIRECTORIES)
  foreach(subfolder ${subfolders})
    read_headers_once(${subfolder})
  endforeach()
endfunction()

foreach(room segmentation fitting/mesh fitting solver registration pipeline)
  read_headers_once(${CMAKE_SOURCE_DIR}/${room})
endforeach()
if(MAMMOTWIN_TESTS)
  read_headers_once(${CMAKE_SOURCE_DIR}/tests)
endif()
