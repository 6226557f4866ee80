# PROGRAM says that a filter names none of its benchmarks, and ends with exit code 2: a crash, or a program that is
# not there, fails.
#   cmake -DPROGRAM=... -P names_nothing.cmake
execute_process(COMMAND ${PROGRAM} --benchmark_filter=no_such_benchmark
  RESULT_VARIABLE code OUTPUT_VARIABLE said ERROR_VARIABLE complained)
if(NOT code STREQUAL "2")
  message(FATAL_ERROR "${PROGRAM} ended with \"${code}\" instead of 2\n${said}${complained}")
endif()
if(NOT complained MATCHES "Failed to match any benchmarks against regex: no_such_benchmark")
  message(FATAL_ERROR "${PROGRAM} did not say what it did not find\n${said}${complained}")
endif()
