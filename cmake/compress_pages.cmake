# Of what goes into a package of Debian, the pages of man and the changelogs are compressed, as it wants them. CPack runs this
# once all is installed.
if(CPACK_GENERATOR STREQUAL "DEB")
  file(GLOB_RECURSE pages LIST_DIRECTORIES false ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/*)
  list(FILTER pages INCLUDE REGEX "/man/man1/[^/]+\\.1$|/changelog\\.Debian$")
  execute_process(COMMAND gzip -9nf ${pages} COMMAND_ERROR_IS_FATAL ANY)
endif()
