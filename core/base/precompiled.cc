// The precompiled headers (CMakeLists.txt) need one source file.
