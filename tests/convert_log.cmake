# Converts LOG into FOLDER by CONVERT. Where the log is absent there is nothing to do: the scenario
# that needs it skips itself.
if(NOT EXISTS "${LOG}")
  message(STATUS "there is no log ${LOG}: its scenario is skipped")
  return()
endif()
execute_process(COMMAND "${PYTHON}" "${CONVERT}" "${LOG}" "${FOLDER}" COMMAND_ERROR_IS_FATAL ANY)
