# cmake -DOUT=pages.cc -DOPENAPI=openapi.json -DDOCS=docs.html -P embed.cmake
# Writes a source file that holds the two files as they are.
file(READ "${OPENAPI}" openapi)
file(READ "${DOCS}" docs)
foreach(text openapi docs)
  string(FIND "${${text}}" ")ARMLOOM\"" end)
  if(NOT end EQUAL -1)
    message(FATAL_ERROR "${text} holds the end mark )ARMLOOM\"")
  endif()
endforeach()
file(WRITE "${OUT}" "#include \"server/openapi/openapi.h\"\n\nnamespace armloom {\n\n")
file(APPEND "${OUT}" "std::string_view openapi_json() {\n  return R\"ARMLOOM(" "${openapi}" ")ARMLOOM\";\n}\n\n")
file(APPEND "${OUT}" "std::string_view docs_html() {\n  return R\"ARMLOOM(" "${docs}" ")ARMLOOM\";\n}\n\n")
file(APPEND "${OUT}" "}  // namespace armloom\n")
