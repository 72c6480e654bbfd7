# `functions`: those that a header of the folder HEADERS declares or defines at the beginning of a line. Those that it
# defines are in the library as well, for other languages.
set(functions "")
file(GLOB headers "${HEADERS}/deldrift/*.h")
foreach(header IN LISTS headers)
  file(READ "${header}" text)
  string(REGEX MATCHALL "\n(static inline |const )?[a-z0-9_]+ [*]?deldrift_[a-z0-9_]+[(]" declared "${text}")
  list(LENGTH declared n_declared)
  if(n_declared EQUAL 0)
    message(FATAL_ERROR "No functions in ${header}")
  endif()
  list(APPEND functions ${declared})
endforeach()
list(TRANSFORM functions REPLACE ".*(deldrift_[a-z0-9_]+)[(]" "\\1")
