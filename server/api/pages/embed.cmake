# cmake -DOUT=pages.cc -DFOLDER=. -P embed.cmake
# Writes a C++ source file with one function for each of these files, which returns the unchanged text of the file.
file(WRITE "${OUT}" "#include \"server/api/openapi.h\"\n\nnamespace armloom {\n\n")
foreach(name docs.html docs.css docs.js login.html login.js)
  file(READ "${FOLDER}/${name}" text)
  string(FIND "${text}" ")ARMLOOM\"" end)
  if(NOT end EQUAL -1)
    message(FATAL_ERROR "${name} holds the end mark )ARMLOOM\"")
  endif()
  string(REPLACE "." "_" function "${name}")
  file(APPEND "${OUT}" "std::string_view ${function}() {\n  return R\"ARMLOOM(" "${text}" ")ARMLOOM\";\n}\n\n")
endforeach()
file(APPEND "${OUT}" "}  // namespace armloom\n")
