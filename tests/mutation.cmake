# Runs a scenario with the arguments of a mutation; it must exit with CODE.
string(REGEX REPLACE " +--set +" "|" overrides " ${ARGUMENTS}")
string(REGEX MATCHALL "[^|]+" overrides "${overrides}")
set(arguments "")
foreach(override IN LISTS overrides)
  list(APPEND arguments --set "${override}")
endforeach()
execute_process(COMMAND "${PROGRAM}" run "${SCENARIO}" --quiet --out "${OUT}" ${arguments}
                RESULT_VARIABLE result OUTPUT_VARIABLE text ERROR_VARIABLE text)
if(NOT result EQUAL CODE)
  message(FATAL_ERROR "expected exit ${CODE}, found ${result}:\n${text}")
endif()
