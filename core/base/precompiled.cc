// The headers that are compiled once for all (CMakeLists.txt) need a source to be compiled with.
