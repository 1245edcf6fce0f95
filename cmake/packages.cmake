# Packages of a portable build, as scripts/package makes them: Debian's by `cpack -G DEB`, a component each, and an archive
# that runs wherever it is unpacked by `cpack -G TGZ`.

set(FOLK_MAINTAINER "The Folk authors <folk@localhost>" CACHE STRING "Whom Debian packages name: who makes them public")
option(FOLK_BUNDLE "Install the libraries that programs need beside them, for a system that does not have them" OFF)

set(CPACK_PACKAGE_NAME folk)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "toolkit for repeated games")
set(CPACK_PACKAGE_CONTACT ${FOLK_MAINTAINER})
set(CPACK_PACKAGE_FILE_NAME folk-${PROJECT_VERSION}-${CMAKE_SYSTEM_NAME}-${CMAKE_SYSTEM_PROCESSOR})
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/cmake/compress_pages.cmake)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_COMPONENTS_ALL)

# folk_package(NAME SECTION section DEPENDS ... RECOMMENDS ... DESCRIPTION text): the component of this name as
# a package, with the papers that every package of Debian has; shared libraries are found by dpkg-shlibdeps.
function(folk_package name)
  cmake_parse_arguments(ARG "" "SECTION;DESCRIPTION" "DEPENDS;RECOMMENDS" ${ARGN})
  string(TOUPPER ${name} key)
  list(JOIN ARG_DEPENDS ", " depends)
  list(JOIN ARG_RECOMMENDS ", " recommends)
  set(CPACK_COMPONENTS_ALL ${CPACK_COMPONENTS_ALL} ${name} PARENT_SCOPE)
  set(CPACK_DEBIAN_${key}_PACKAGE_NAME ${name} PARENT_SCOPE)
  set(CPACK_DEBIAN_${key}_PACKAGE_SECTION ${ARG_SECTION} PARENT_SCOPE)
  set(CPACK_DEBIAN_${key}_PACKAGE_DEPENDS "${depends}" PARENT_SCOPE)
  set(CPACK_DEBIAN_${key}_PACKAGE_RECOMMENDS "${recommends}" PARENT_SCOPE)
  set(CPACK_DEBIAN_${key}_PACKAGE_SHLIBDEPS ON PARENT_SCOPE)
  set(CPACK_DEBIAN_${key}_DESCRIPTION "${ARG_DESCRIPTION}" PARENT_SCOPE)

  set(papers ${PROJECT_BINARY_DIR}/packages/${name})
  configure_file(${PROJECT_SOURCE_DIR}/cmake/debian_changelog.in ${papers}/changelog.Debian @ONLY)
  install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${name} RENAME copyright COMPONENT ${name}
          EXCLUDE_FROM_ALL)
  install(FILES ${papers}/changelog.Debian DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${name} COMPONENT ${name} EXCLUDE_FROM_ALL)
endfunction()

folk_package(folk SECTION science RECOMMENDS graphviz gnuplot-nox
  DESCRIPTION "Tournaments of the iterated prisoner's dilemma that are exact where others\nsample, strategies as machines that can be compared and drawn, equilibrium\nclaims with certificates, evolution, and a self-confirming transformer that\nplays on its own beliefs: the programs.")
folk_package(libfolk-dev SECTION libdevel DEPENDS libboost-dev libeigen3-dev libfmt-dev libnlopt-dev nlohmann-json3-dev
  DESCRIPTION "The libraries of Folk for C++20: headers, archives, a CMake package and a file\nfor pkg-config; all that the programs of the package folk can do.")
if(TARGET Folk::flint)
  string(APPEND CPACK_DEBIAN_LIBFOLK-DEV_PACKAGE_DEPENDS ", libflint-dev, libgmp-dev")
endif()
if(FOLK_HAS_MPI)
  folk_package(folk-mpi SECTION science DEPENDS "folk (= ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})"
  DESCRIPTION "Lets the ranks that mpirun or srun start share the work of a tournament or of\nan evolution.")
endif()

if(FOLK_HAS_PYTHON)
  # The module is for one Python; Debian's interpreter finds the package in dist-packages, and the data are those of the programs.
  math(EXPR next_minor "${Python_VERSION_MINOR} + 1")
  folk_package(python3-folk SECTION python DEPENDS "folk (= ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})"
    "python3 (>= ${Python_VERSION_MAJOR}.${Python_VERSION_MINOR})" "python3 (<< ${Python_VERSION_MAJOR}.${next_minor})" python3-numpy
    RECOMMENDS python3-pandas python3-networkx
  DESCRIPTION "import folk: tournaments, equilibrium claims, evolution, the transformer and the\nparticle world from Python, with numpy arrays, and with players that are written\nin Python.")
  set(CPACK_DEBIAN_PYTHON3-FOLK_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/cmake/debian/postinst ${PROJECT_SOURCE_DIR}/cmake/debian/prerm)
  set(CPACK_DEBIAN_PYTHON3-FOLK_PACKAGE_CONTROL_STRICT_PERMISSION ON)
  folk_install_python(lib/python3/dist-packages python3-folk)
  set(data_link ${PROJECT_BINARY_DIR}/packages/python3-folk/data)
  file(RELATIVE_PATH data /lib/python3/dist-packages/folk /${CMAKE_INSTALL_DATADIR}/folk)
  file(CREATE_LINK ${data} ${data_link} SYMBOLIC)
  install(FILES ${data_link} DESTINATION lib/python3/dist-packages/folk COMPONENT python3-folk EXCLUDE_FROM_ALL)
endif()

# What README and the pages of man speak of.
set(doc ${CMAKE_INSTALL_DATADIR}/doc/folk)
install(FILES README.md CHANGELOG.md CITATION.cff DESTINATION ${doc} COMPONENT folk)
install(DIRECTORY docs examples DESTINATION ${doc} COMPONENT folk PATTERN docs/study/work EXCLUDE PATTERN __pycache__ EXCLUDE)

if(FOLK_BUNDLE)
  # Programs, and the libraries among themselves (which takes the old kind of path), look for them in PREFIX/lib/folk; the C
  # library is the system's.
  file(RELATIVE_PATH from_program ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_PREFIX}/lib/folk)
  foreach(program ${FOLK_PROGRAMS_BUILT})
    set_target_properties(${program} PROPERTIES INSTALL_RPATH $ORIGIN/${from_program})
    target_link_options(${program} PRIVATE LINKER:--disable-new-dtags)
  endforeach()
  install(TARGETS ${FOLK_PROGRAMS_BUILT} RUNTIME_DEPENDENCY_SET folk_libraries RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT folk)
  install(RUNTIME_DEPENDENCY_SET folk_libraries DESTINATION lib/folk COMPONENT folk
          PRE_EXCLUDE_REGEXES "^lib(c|m)\\.so" "^ld-linux" POST_EXCLUDE_REGEXES "/lib(c|m)\\.so" "/ld-linux")
  install(FILES LICENSE DESTINATION ${doc} COMPONENT folk)
endif()

include(CPack)
