# Runs COMMAND, a list, or says that the packages of npm in MODULES are missing.
if(NOT EXISTS ${MODULES}/playwright-core)
  message("SKIPPED: run npm ci in tests/browser first")
  return()
endif()
execute_process(COMMAND ${COMMAND} RESULT_VARIABLE result)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "ended with ${result}")
endif()
