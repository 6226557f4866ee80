# cmake -DOUT=pages.cc -DFOLDER=. -P embed.cmake
# Writes a source file that holds docs.html, docs.css and docs.js as they are.
file(WRITE "${OUT}" "#include \"server/openapi/openapi.h\"\n\nnamespace armloom {\n\n")
foreach(part html css js)
  file(READ "${FOLDER}/docs.${part}" text)
  string(FIND "${text}" ")ARMLOOM\"" end)
  if(NOT end EQUAL -1)
    message(FATAL_ERROR "docs.${part} holds the end mark )ARMLOOM\"")
  endif()
  file(APPEND "${OUT}" "std::string_view docs_${part}() {\n  return R\"ARMLOOM(" "${text}" ")ARMLOOM\";\n}\n\n")
endforeach()
file(APPEND "${OUT}" "}  // namespace armloom\n")
