# Python with pybind11 and numpy, where FOLK_PYTHON wants them and they are found: the package in python/ is built then. What it
# links is compiled so that a module can hold it.
set(FOLK_HAS_PYTHON OFF)
if(FOLK_PYTHON)
  find_package(Python 3.9 QUIET COMPONENTS Interpreter Development.Module NumPy)
  set(PYBIND11_FINDPYTHON ON)  # no second search by an older module
  find_package(pybind11 2.10 QUIET CONFIG)
  if(Python_FOUND AND pybind11_FOUND)
    set(FOLK_HAS_PYTHON ON)
    set(CMAKE_POSITION_INDEPENDENT_CODE ON)
  elseif(NOT FOLK_PYTHON STREQUAL "AUTO")
    message(FATAL_ERROR "FOLK_PYTHON is ${FOLK_PYTHON}, but Python with pybind11 and numpy is not found (Debian: python3-dev, pybind11-dev, python3-numpy)")
  endif()
endif()
