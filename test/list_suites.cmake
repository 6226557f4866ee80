# Writes OUT: a ctest entry for each suite of the GoogleTest program PROGRAM.
execute_process(COMMAND ${PROGRAM} --gtest_list_tests OUTPUT_VARIABLE told COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "(^|\n)[^ \n][^ \n]*\\." suites "${told}")  # claims are indented
list(LENGTH suites count)
if(count EQUAL 0)
  message(FATAL_ERROR "${PROGRAM} lists no suite: ${told}")
endif()
set(text "")
foreach(suite ${suites})
  string(STRIP "${suite}" suite)
  string(APPEND text "add_test([=[${suite}*]=] [=[${PROGRAM}]=] [=[--gtest_filter=${suite}*]=])\n"
    "set_tests_properties([=[${suite}*]=] PROPERTIES LABELS cpp)\n")
endforeach()
file(WRITE ${OUT} "${text}")
