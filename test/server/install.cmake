# cmake -DBUILD=build -DPREFIX=folder -P install.cmake
# What `cmake --install` puts there runs from there: the program knows its version, and its cells.
file(REMOVE_RECURSE "${PREFIX}")
execute_process(COMMAND ${CMAKE_COMMAND} --install "${BUILD}" --prefix "${PREFIX}"
  RESULT_VARIABLE failed OUTPUT_QUIET)
if(failed)
  message(FATAL_ERROR "cmake --install: ${failed}")
endif()
execute_process(COMMAND "${PREFIX}/bin/armloom" --version RESULT_VARIABLE failed OUTPUT_VARIABLE said)
if(failed OR NOT said STREQUAL "armloom ${VERSION}\n")
  message(FATAL_ERROR "--version: ${failed}: ${said}")
endif()
execute_process(
  COMMAND "${PREFIX}/bin/armloom" validate --cell "${PREFIX}/share/armloom/config/two_pandas.json"
  RESULT_VARIABLE failed OUTPUT_QUIET ERROR_VARIABLE said)
if(failed)
  message(FATAL_ERROR "validate: ${failed}: ${said}")
endif()
file(REMOVE_RECURSE "${PREFIX}")
