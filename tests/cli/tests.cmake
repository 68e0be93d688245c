# Tests of the program by its command line alone, each file one test.
function(_reckon_cli_test name)
  add_test(NAME "cli.${name}"
           COMMAND "${CMAKE_COMMAND}" -E env "RECKON_PROGRAM=$<TARGET_FILE:reckon>"
                   PYTHONDONTWRITEBYTECODE=1
                   "${RECKON_PYTHON}" "${CMAKE_CURRENT_SOURCE_DIR}/cli/${name}_test.py")
  set_tests_properties("cli.${name}" PROPERTIES LABELS fast TIMEOUT 600)
endfunction()

_reckon_cli_test(exit_codes)
_reckon_cli_test(folders)
_reckon_cli_test(interrupt)
_reckon_cli_test(memory)
_reckon_cli_test(output)
_reckon_cli_test(score)
