# The libraries in FROM, without debug information, to TO. The static one becomes a single object in which only what the
# headers in the folder HEADERS declare is global: the rest is of no use to programs, and could clash with another
# library written in Rust.
include("${CMAKE_CURRENT_LIST_DIR}/run.cmake")
include("${CMAKE_CURRENT_LIST_DIR}/functions.cmake")

file(MAKE_DIRECTORY "${TO}")
run("${STRIP}" --strip-unneeded -o "${TO}/libdeldrift.so" "${FROM}/libdeldrift.so")

list(TRANSFORM functions PREPEND "--undefined=" OUTPUT_VARIABLE wanted)
string(REPLACE ";" "\n" names "${functions}")
file(WRITE "${TO}/functions.txt" "${names}\n")
# Groups of sections end here. One that stayed would be thrown away beside another library that has a group of that name,
# as rustc makes for DW.ref.rust_eh_personality, and with it what is local by then, which nothing else can replace.
run("${LINKER}" -r --force-group-allocation --gc-sections ${wanted} -o "${TO}/deldrift.o" "${FROM}/libdeldrift.a")
# The bitcode that the objects of Rust's standard library carry is not one any more when it is linked.
run("${OBJCOPY}" --strip-debug --remove-section=.llvmbc --remove-section=.llvmcmd
  "--keep-global-symbols=${TO}/functions.txt" "${TO}/deldrift.o")
run("${STRIP}" --strip-unneeded "${TO}/deldrift.o")
file(REMOVE "${TO}/libdeldrift.a")
run("${AR}" crs "${TO}/libdeldrift.a" "${TO}/deldrift.o")
