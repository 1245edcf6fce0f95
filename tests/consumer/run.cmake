# cmake -DMODE=installed|pkg_config|tree -DFOLK_BUILD=DIR -DWORK=DIR -DGENERATOR= -DCOMPILER= -DFLAGS= -P run.cmake
# installed: builds the consumers in WORK against an installed copy of FOLK_BUILD and runs them.
# pkg_config: the same by pkg-config, without the CMake package.
# tree: compiles them in WORK with Folk's tree as a part of its build.
# FLAGS are those of FOLK_BUILD: what is built for a sanitizer links with nothing else.
cmake_minimum_required(VERSION 3.25)

function(step)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

get_filename_component(tree ${CMAKE_CURRENT_LIST_DIR}/../.. ABSOLUTE)
set(options -G ${GENERATOR} -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_CXX_FLAGS=${FLAGS} -DCMAKE_BUILD_TYPE=Debug)

file(REMOVE_RECURSE ${WORK})
if(MODE STREQUAL "tree")
  list(APPEND options -DFOLK_TREE=${tree})
else()
  step(${CMAKE_COMMAND} --install ${FOLK_BUILD} --prefix ${WORK}/prefix)
  list(APPEND options -DCMAKE_PREFIX_PATH=${WORK}/prefix)
endif()
if(MODE STREQUAL "pkg_config")
  list(APPEND options -DFOLK_BY_PKG_CONFIG=ON)
endif()
step(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR} -B ${WORK}/build ${options})
step(${CMAKE_COMMAND} --build ${WORK}/build --target consumer check_equilibrium particle_world)
if(NOT MODE STREQUAL "tree")
  step(${WORK}/build/consumer)
  execute_process(COMMAND ${WORK}/build/particle_world OUTPUT_VARIABLE said COMMAND_ERROR_IS_FATAL ANY)
  if(NOT said STREQUAL "mean return of a predator: 205.23\n")
    message(FATAL_ERROR "particle_world said: ${said}")
  endif()

  # The conclusion of sce-check, notion by notion, from the program itself where it was built.
  set(conclusion "nash: refuted, gain 0.5, in round 1, plays D, then best reply
subgame_perfect: refuted, gain 0.32, in round 1, plays D, then both go on as their machines say
self_confirming_unrestricted: certified, gain 0
self_confirming_class: certified, gain 0, spiteful
")
  if(EXISTS ${FOLK_BUILD}/bin/sce-check)
    execute_process(COMMAND ${FOLK_BUILD}/bin/sce-check pavlov pavlov --criterion discounted:0.6 --class classics
                            --format json OUTPUT_VARIABLE report COMMAND_ERROR_IS_FATAL ANY)
    set(conclusion "")
    foreach(notion nash subgame_perfect self_confirming_unrestricted self_confirming_class)
      foreach(part word margin_exact witness)
        string(JSON ${part} GET ${report} overall verdicts ${notion} ${part})
      endforeach()
      string(APPEND conclusion "${notion}: ${word}, gain ${margin_exact}")
      if(witness)
        string(APPEND conclusion ", ${witness}")
      endif()
      string(APPEND conclusion "\n")
    endforeach()
  endif()
  execute_process(COMMAND ${WORK}/build/check_equilibrium OUTPUT_VARIABLE said COMMAND_ERROR_IS_FATAL ANY)
  if(NOT said STREQUAL conclusion)
    message(FATAL_ERROR "check_equilibrium said:\n${said}and not:\n${conclusion}")
  endif()
endif()
