# cmake -DOUT=pages.cc -DDOCS=docs.html -P embed.cmake
# Writes a source file that holds the page as it is.
file(READ "${DOCS}" docs)
string(FIND "${docs}" ")ARMLOOM\"" end)
if(NOT end EQUAL -1)
  message(FATAL_ERROR "the page holds the end mark )ARMLOOM\"")
endif()
file(WRITE "${OUT}" "#include \"server/openapi/openapi.h\"\n\nnamespace armloom {\n\n")
file(APPEND "${OUT}" "std::string_view docs_html() {\n  return R\"ARMLOOM(" "${docs}" ")ARMLOOM\";\n}\n\n")
file(APPEND "${OUT}" "}  // namespace armloom\n")
