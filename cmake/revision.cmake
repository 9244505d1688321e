# cmake -DSOURCE_DIR=... -DHEADER=... -P revision.cmake: writes the revision into HEADER, if that changes it.
cmake_minimum_required(VERSION 3.22)
execute_process(COMMAND git describe --always --dirty WORKING_DIRECTORY ${SOURCE_DIR}
  OUTPUT_VARIABLE revision OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(NOT revision)
  set(revision unknown)
endif()
file(CONFIGURE OUTPUT ${HEADER} CONTENT "#define STACKABILIZATION_REVISION \"@revision@\"\n" @ONLY)
