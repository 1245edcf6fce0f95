# What a terminal wants beside the programs: pages for man, and completion for bash, zsh and fish.

# A page is what its program says of itself; a verb that is a program of its own has one too.
set(man_pages)
function(folk_man_page page program)
  set(file ${PROJECT_BINARY_DIR}/share/man/man1/${page}.1)
  add_custom_command(OUTPUT ${file} COMMAND ${program} ${ARGN} --man > ${file} DEPENDS ${program} VERBATIM)
  set(man_pages ${man_pages} ${file} PARENT_SCOPE)
endfunction()

file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/share/man/man1)
foreach(program ${programs})
  folk_man_page(${program} ${program})
endforeach()
foreach(verb online curve collect inspect offline study)
  folk_man_page(mpe-train-${verb} mpe-train ${verb})
endforeach()
add_custom_target(folk_man_pages ALL DEPENDS ${man_pages})

# Each shell looks for a file that is called after the program; zsh's begin with "_".
set(completion_folders bash-completion/completions zsh/${FOLK_ZSH_FOLDER} fish/vendor_completions.d)
set(share ${PROJECT_BINARY_DIR}/share)
set(completion ${PROJECT_SOURCE_DIR}/cmake/completion/completion)
foreach(program ${programs})
  configure_file(${completion}.bash.in ${share}/bash-completion/completions/${program} @ONLY)
  configure_file(${completion}.zsh.in ${share}/zsh/${FOLK_ZSH_FOLDER}/_${program} @ONLY)
  configure_file(${completion}.fish.in ${share}/fish/vendor_completions.d/${program}.fish @ONLY)
endforeach()

if(FOLK_INSTALL)
  install(FILES ${man_pages} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT folk)
  foreach(folder ${completion_folders})
    cmake_path(GET folder PARENT_PATH shell)
    install(DIRECTORY ${share}/${folder} DESTINATION ${CMAKE_INSTALL_DATADIR}/${shell} COMPONENT folk)
  endforeach()
endif()
