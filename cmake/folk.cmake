# How every target of Folk is built, and how the package is installed.

# An include line is <folk/games/match.h> in the tree as in an installed copy: the build folder holds a link to the tree.
set(FOLK_INCLUDE_ROOT ${PROJECT_BINARY_DIR}/include)
file(MAKE_DIRECTORY ${FOLK_INCLUDE_ROOT})
file(CREATE_LINK ${PROJECT_SOURCE_DIR} ${FOLK_INCLUDE_ROOT}/folk SYMBOLIC)

include(CheckCXXCompilerFlag)
check_cxx_compiler_flag(-march=native FOLK_HAS_MARCH_NATIVE)

function(folk_compile_options target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wconversion -Wshadow)
  target_compile_options(${target} PRIVATE -Wno-psabi)  # vectors of lanes (analysis/classes) stay within one library
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    # False alarms of GCC 12 in other people's headers: std::string (bug 105329), its own AVX-512 intrinsics under Eigen
    # (bug 105593) and Boost's cpp_int.
    target_compile_options(${target} PRIVATE -Wno-restrict -Wno-stringop-overflow -Wno-maybe-uninitialized -Wno-uninitialized)
  endif()
  if(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    target_compile_options(${target} PRIVATE -Wno-sign-conversion -Wno-missing-braces)  # as GCC understands these options
  endif()
  if(FOLK_FOLDERS_AS_ONE)
    target_compile_options(${target} PRIVATE -Wno-shadow)  # of what another source of the folder calls so
  endif()
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # GCC tidies its memory only from 1 GB on: a large source takes an eighth less time.
    target_compile_options(${target} PRIVATE "SHELL:--param ggc-min-heapsize=1048576" "SHELL:--param ggc-min-expand=100")
  endif()
  if(FOLK_WERROR)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
  if(NOT FOLK_PORTABLE AND FOLK_HAS_MARCH_NATIVE)
    target_compile_options(${target} PRIVATE -march=native)
  endif()
endfunction()

# The large headers of others are read once a target. That a header includes all it needs is checked by itself:
# tests/house/headers_alone.py.
option(FOLK_PRECOMPILED_HEADERS "Read the headers of other libraries once a target" ${PROJECT_IS_TOP_LEVEL})

# folk_precompile(TARGET HEADER...): those headers and the usual ones of the standard library.
# folk_precompile(TARGET REUSE_FROM OTHER): what was read for OTHER, a target with the same options and definitions.
function(folk_precompile target)
  if(NOT FOLK_PRECOMPILED_HEADERS)
    return()
  endif()
  if(ARGV1 STREQUAL "REUSE_FROM")
    target_precompile_headers(${target} REUSE_FROM ${ARGV2})
  else()
    target_precompile_headers(${target} PRIVATE ${ARGN} <fmt/format.h> <algorithm> <cmath> <functional> <map> <memory>
                              <optional> <string> <vector>)
  endif()
endfunction()

# For builds that are made once (scripts/, the sanitizers): the sources of a folder are compiled as one, which reads each
# header once a folder and takes a third of the time. So no two sources of a folder may name two things alike. ON spares the
# sources in which products are fused with sums: what is fused depends on what is inlined, and with it a last digit.
set(FOLK_FOLDERS_AS_ONE OFF CACHE STRING "Compile the sources of each folder as one: OFF, ON where no number can change, ALL")
set(FOLK_OPTIMISED_FOLDERS "" CACHE STRING "Folders that FOLK_FOLDERS_AS_ONE compiles with -O1, such as sct_network")

# folk_folders_as_one(TARGET SOURCE...)
function(folk_folders_as_one target)
  if(NOT FOLK_FOLDERS_AS_ONE)
    return()
  endif()
  foreach(source ${ARGN})
    cmake_path(GET source PARENT_PATH folder)
    file(RELATIVE_PATH group ${PROJECT_SOURCE_DIR} ${folder})
    string(REPLACE "/" "_" group ${group})
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${group})
    # Nothing waits for a drawing: in Release too -O1 is enough.
    if(group IN_LIST FOLK_OPTIMISED_FOLDERS OR (CMAKE_BUILD_TYPE STREQUAL "Release" AND group MATCHES "_(pictures|study)$"))
      set(one ${CMAKE_CURRENT_BINARY_DIR}/CMakeFiles/${target}.dir/Unity/unity_${group}_cxx.cxx)
      set_source_files_properties(${one} PROPERTIES COMPILE_OPTIONS -O1 SKIP_PRECOMPILE_HEADERS ON)
    endif()
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
endfunction()

# A second build of the same source is a look-up; the two settings are what precompiled headers need.
find_program(FOLK_CCACHE ccache)
if(FOLK_CCACHE AND PROJECT_IS_TOP_LEVEL AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros ${FOLK_CCACHE})
endif()

# lld links in a fraction of the time.
include(CheckLinkerFlag)
check_linker_flag(CXX -fuse-ld=lld FOLK_HAS_LLD)
if(FOLK_HAS_LLD AND PROJECT_IS_TOP_LEVEL)
  add_link_options(-fuse-ld=lld)
endif()

set(FOLK_LEFT_OUT "" CACHE STRING "Regular expression: sources of the libraries that this build has no use for")

# folk_library(games DEPENDS fmt::fmt): the library of this folder, folk::games, from all its sources, those in
# its rooms too. No product is fused with a sum, so that its numbers are the same on every processor, but in the sources FUSED.
# PRECOMPILED_FOR strategies: it takes what was read for that library.
function(folk_library name)
  cmake_parse_arguments(ARG "" "PRECOMPILED_FOR" "FUSED;DEPENDS;PRIVATE_DEPENDS" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  file(GLOB_RECURSE headers CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.h)
  if(FOLK_LEFT_OUT)
    list(FILTER sources EXCLUDE REGEX "${FOLK_LEFT_OUT}")
  endif()
  add_library(folk_${name} ${sources} ${headers})
  add_library(folk::${name} ALIAS folk_${name})
  set_target_properties(folk_${name} PROPERTIES EXPORT_NAME ${name})
  folk_compile_options(folk_${name})
  if(ARG_PRECOMPILED_FOR)
    folk_precompile(folk_${name} REUSE_FROM folk_${ARG_PRECOMPILED_FOR})
  else()
    folk_precompile(folk_${name})
  endif()
  folk_folders_as_one(folk_${name} ${sources})
  if(NOT ARG_FUSED OR NOT FOLK_FOLDERS_AS_ONE STREQUAL "ALL")
    target_compile_options(folk_${name} PRIVATE -ffp-contract=off)
    set_property(SOURCE ${ARG_FUSED} APPEND PROPERTY COMPILE_OPTIONS -ffp-contract=$<IF:$<CXX_COMPILER_ID:GNU>,fast,on>)
    # GCC takes what is fused from the precompiled header, whatever the command line says.
    set_source_files_properties(${ARG_FUSED} PROPERTIES SKIP_PRECOMPILE_HEADERS ON SKIP_UNITY_BUILD_INCLUSION ON)
  endif()
  target_include_directories(folk_${name} PUBLIC $<BUILD_INTERFACE:${FOLK_INCLUDE_ROOT}>
                                                 $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_link_libraries(folk_${name} PUBLIC ${ARG_DEPENDS} PRIVATE ${ARG_PRIVATE_DEPENDS})
  if(FOLK_INSTALL)
    install(TARGETS folk_${name} EXPORT FolkTargets
            ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT libfolk-dev
            LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT libfolk-dev)
    install(DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/folk/${name} COMPONENT libfolk-dev
            FILES_MATCHING PATTERN "*.h")
  endif()
endfunction()

# folk_program(ipd-match): a program in build/bin/, from all sources of ipd_match/. What is not its main.cpp is a library of
# its own, folk_ipd_match, which python/ links too: it is what the program asks, answers and writes.
function(folk_program name)
  string(REPLACE "-" "_" folder ${name})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${folder}/*.cpp)
  list(REMOVE_ITEM sources ${CMAKE_CURRENT_SOURCE_DIR}/${folder}/main.cpp)
  set(parts folk_program_support)
  if(sources)
    add_library(folk_${folder} STATIC EXCLUDE_FROM_ALL ${sources})
    folk_compile_options(folk_${folder})
    target_link_libraries(folk_${folder} PUBLIC folk_program_support)
    folk_precompile(folk_${folder} REUSE_FROM folk_program_support)
    folk_folders_as_one(folk_${folder} ${sources})
    set(parts folk_${folder})
  endif()
  if(NOT FOLK_PROGRAMS)
    return()
  endif()
  add_executable(${name} ${CMAKE_CURRENT_SOURCE_DIR}/${folder}/main.cpp)
  folk_compile_options(${name})
  target_link_libraries(${name} PRIVATE ${parts})
  if(FOLK_HAS_PYTHON)  # as what a module holds is compiled, or what was read for that could not be taken
    target_compile_options(${name} PRIVATE -fPIC)
  endif()
  folk_precompile(${name} REUSE_FROM folk_program_support)
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
  if(FOLK_INSTALL)
    install(TARGETS ${name} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT folk)
  endif()
endfunction()

function(folk_install_package)
  include(CMakePackageConfigHelpers)
  set(FOLK_HAS_FLINT OFF)
  if(TARGET Folk::flint)
    set(FOLK_HAS_FLINT ON)
  endif()
  configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/FolkConfig.cmake.in ${PROJECT_BINARY_DIR}/FolkConfig.cmake
                                INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/Folk)
  write_basic_package_version_file(${PROJECT_BINARY_DIR}/FolkConfigVersion.cmake COMPATIBILITY SameMinorVersion)
  install(FILES ${PROJECT_BINARY_DIR}/FolkConfig.cmake ${PROJECT_BINARY_DIR}/FolkConfigVersion.cmake
                ${PROJECT_SOURCE_DIR}/cmake/flint.cmake
          DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/Folk COMPONENT libfolk-dev)
  install(EXPORT FolkTargets NAMESPACE folk:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/Folk COMPONENT libfolk-dev)

  # For those who build without CMake: one file for all libraries, in the order in which a linker wants them. They are
  # archives, so whoever links them links what they need.
  set(pc_folder ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
  file(RELATIVE_PATH prefix_from_pc /${pc_folder} /)
  string(REGEX REPLACE "/$" "" prefix_from_pc ${prefix_from_pc})
  set(pc_libraries "-lfolk_mpe -lfolk_sct -lfolk_analysis -lfolk_strategies -lfolk_games")
  if(FOLK_HAS_FLINT)
    string(APPEND pc_libraries " -lflint -lgmp")
  endif()
  configure_file(${PROJECT_SOURCE_DIR}/cmake/folk.pc.in ${PROJECT_BINARY_DIR}/folk.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/folk.pc DESTINATION ${pc_folder} COMPONENT libfolk-dev)
endfunction()
