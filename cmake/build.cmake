# Has cargo (CARGO) build the libraries of the sources in FROM, in the folder that CARGO_TARGET_DIR names at this moment, or
# else in TARGET, which was the one when the project was configured. From elsewhere the libraries are copied to where
# TARGET would have them, as that is where other targets look.
set(target "$ENV{CARGO_TARGET_DIR}")
if(NOT target)
  set(target "${TARGET}")
endif()
get_filename_component(target "${target}" ABSOLUTE BASE_DIR "${FROM}")

execute_process(COMMAND "${CARGO}" build --release --lib --target-dir "${target}"
  WORKING_DIRECTORY "${FROM}" RESULT_VARIABLE result)
if(result)
  message(FATAL_ERROR "cargo could not build deldrift: ${result}")
endif()
foreach(name IN ITEMS libdeldrift.so libdeldrift.a)
  if(NOT EXISTS "${target}/release/${name}")
    message(FATAL_ERROR "cargo has not left ${name} in ${target}/release, as it does unless it is told to build for "
                        "another system; see DELDRIFT_LIBRARY_DIR")
  endif()
endforeach()
if(target STREQUAL TARGET)
  return()
endif()

# What is there is removed first: cargo gives its files several names. A copy has the time of what it is a copy of.
foreach(name IN ITEMS libdeldrift.so libdeldrift.a "${SONAME}")
  execute_process(COMMAND "${CMAKE_COMMAND}" -E compare_files "${target}/release/${name}" "${TARGET}/release/${name}"
    RESULT_VARIABLE differs OUTPUT_QUIET ERROR_QUIET)
  if(differs)
    file(REMOVE "${TARGET}/release/${name}")
    file(COPY "${target}/release/${name}" DESTINATION "${TARGET}/release")
  endif()
endforeach()
