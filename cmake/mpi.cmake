# MPI with Boost.MPI, where FOLK_MPI wants them and they are found: the component mpi/ is built then. It can be left out:
# programs that several ranks of a launcher run say so in one line, and all else is as ever.
set(FOLK_HAS_MPI OFF)
if(FOLK_MPI)
  find_package(MPI QUIET COMPONENTS CXX)
  find_package(Boost 1.74 QUIET OPTIONAL_COMPONENTS mpi)
  if(MPI_CXX_FOUND AND TARGET Boost::mpi)
    set(FOLK_HAS_MPI ON)
  elseif(NOT FOLK_MPI STREQUAL "AUTO")
    message(FATAL_ERROR "FOLK_MPI is ${FOLK_MPI}, but MPI with Boost.MPI is not found (Debian: libboost-mpi-dev)")
  endif()
endif()
