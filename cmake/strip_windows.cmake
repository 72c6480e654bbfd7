# The libraries for Windows in FROM, without debug information, to TO, and the list of the functions that the DLL exports,
# those that the headers in the folder HEADERS declare, of which other compilers make an import library.
include("${CMAKE_CURRENT_LIST_DIR}/run.cmake")
include("${CMAKE_CURRENT_LIST_DIR}/functions.cmake")

file(MAKE_DIRECTORY "${TO}")
run("${STRIP}" --strip-unneeded -o "${TO}/deldrift.dll" "${FROM}/deldrift.dll")
run("${STRIP}" --strip-debug -o "${TO}/libdeldrift.a" "${FROM}/libdeldrift.a")
configure_file("${FROM}/libdeldrift.dll.a" "${TO}/libdeldrift.dll.a" COPYONLY)
list(SORT functions)
list(JOIN functions "\n    " names)
file(WRITE "${TO}/deldrift.def" "LIBRARY deldrift.dll\nEXPORTS\n    ${names}\n")
