# Run as a script behind the link of a test program: writes FILE, a test for ctest for each suite of
# PROGRAM. LEFT_OUT: patterns of tests that are not run; PREFIX: before each name; FOLDER: where
# tests write.
set(filter "")
if (LEFT_OUT)
  set(filter "-${LEFT_OUT}")
endif ()
execute_process(COMMAND "${PROGRAM}" --gtest_list_tests "--gtest_filter=*${filter}"
  OUTPUT_VARIABLE listing COMMAND_ERROR_IS_FATAL ANY)
# A suite's line begins with its name and a dot; those of its tests are indented.
string(REGEX MATCHALL "\n[A-Za-z][^ \n]*\\.[ \n]" suites "\n${listing}")
if (NOT suites)
  message(FATAL_ERROR "${PROGRAM} lists no suite of tests")
endif ()
set(script "")
foreach (suite IN LISTS suites)
  string(REGEX REPLACE "[\n ]|\\.[ \n]$" "" suite "${suite}")
  set(name "[==[${PREFIX}${suite}]==]")
  string(APPEND script
    "add_test(${name} [==[${PROGRAM}]==] [==[--gtest_filter=${suite}.*${filter}]==])\n"
    "set_tests_properties(${name} PROPERTIES ENVIRONMENT [==[TEST_TMPDIR=${FOLDER}]==])\n")
endforeach ()
file(WRITE "${FILE}" "${script}")
