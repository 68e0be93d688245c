# The house's budgets and its rules on names and includes, on the files as they lie here.
find_program(RECKON_PYTHON NAMES python3 REQUIRED)
add_test(NAME style.house
         COMMAND "${RECKON_PYTHON}" "${PROJECT_SOURCE_DIR}/tests/style/house.py"
                 "${PROJECT_SOURCE_DIR}")
add_test(NAME style.house_finds_what_is_wrong
         COMMAND "${RECKON_PYTHON}" "${PROJECT_SOURCE_DIR}/tests/style/house_test.py")
set_tests_properties(style.house style.house_finds_what_is_wrong PROPERTIES LABELS style)
