# XPRIMERAY_PYTHON: the Python that draws figures and runs the tests written in Python. Debian's h5py, numpy and
# matplotlib belong to the system's Python, while another one (pyenv, conda) often comes first on PATH: the first that
# imports them is taken. Set it to choose another; NOTFOUND where none has them, which only a build with tests refuses.
if(NOT XPRIMERAY_PYTHON)
  find_program(XPRIMERAY_PYTHON_ON_PATH python3)
  mark_as_advanced(XPRIMERAY_PYTHON_ON_PATH)
  set(python "NOTFOUND")
  foreach(candidate /usr/bin/python3 "${XPRIMERAY_PYTHON_ON_PATH}")
    execute_process(COMMAND "${candidate}" -c "import h5py, matplotlib, numpy"
      RESULT_VARIABLE import_status OUTPUT_QUIET ERROR_QUIET)
    if(import_status STREQUAL "0")
      set(python "${candidate}")
      break()
    endif()
  endforeach()
  set(XPRIMERAY_PYTHON "${python}" CACHE FILEPATH "Python 3 with h5py, numpy and matplotlib" FORCE)
endif()
if(NOT XPRIMERAY_PYTHON AND XPRIMERAY_BUILD_TESTS)
  message(FATAL_ERROR "No Python 3 imports h5py, numpy and matplotlib (Debian packages python3-h5py, python3-numpy, "
    "python3-matplotlib); set XPRIMERAY_PYTHON to one that does.")
endif()
