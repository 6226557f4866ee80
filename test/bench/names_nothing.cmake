# Checks that PROGRAM reports a filter that matches none of its benchmarks, with exit code 2. A crash or a missing
# program fails the check.
#   cmake -DPROGRAM=... -P names_nothing.cmake
execute_process(COMMAND ${PROGRAM} --benchmark_filter=no_such_benchmark
  RESULT_VARIABLE code OUTPUT_VARIABLE said ERROR_VARIABLE complained)
if(NOT code STREQUAL "2")
  message(FATAL_ERROR "${PROGRAM} ended with \"${code}\" instead of 2\n${said}${complained}")
endif()
if(NOT complained MATCHES "Failed to match any benchmarks against regex: no_such_benchmark")
  message(FATAL_ERROR "${PROGRAM} did not say what it did not find\n${said}${complained}")
endif()
