# What is installed, and what `cpack` puts into packages: headers, stripped libraries, files for CMake and pkg-config. The
# shared library, which programs run with, is the component deldrift_runtime; what they are built with is deldrift.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(DELDRIFT_FILE "libdeldrift.so.${PROJECT_VERSION}")
set(DELDRIFT_LINKED_BY "IMPORTED_SONAME \"${DELDRIFT_SONAME}\"")
if(WIN32)
  # Where the loader looks, which is not where linkers do.
  file(RELATIVE_PATH DELDRIFT_FILE "${CMAKE_INSTALL_FULL_LIBDIR}" "${CMAKE_INSTALL_FULL_BINDIR}/deldrift.dll")
  set(DELDRIFT_LINKED_BY "IMPORTED_IMPLIB \"\${deldrift_lib}/libdeldrift.dll.a\"")
endif()
set(compatibility SameMajorVersion)
if(PROJECT_VERSION_MAJOR EQUAL 0)
  set(compatibility SameMinorVersion)
endif()

# Without debug information, and with no other symbols than those of the headers.
set(stripped "${PROJECT_BINARY_DIR}/stripped")
file(GLOB headers CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/include/deldrift/*.h")
set(strip strip)
set(made "${names}")
if(WIN32)
  set(strip strip_windows)
  list(APPEND made deldrift.def)
endif()
list(TRANSFORM names PREPEND "${libraries}/")
list(TRANSFORM made PREPEND "${stripped}/")
add_custom_command(OUTPUT ${made}
  COMMAND "${CMAKE_COMMAND}" "-DFROM=${libraries}" "-DTO=${stripped}"
          "-DHEADERS=${PROJECT_SOURCE_DIR}/include"
          "-DSTRIP=${CMAKE_STRIP}" "-DLINKER=${CMAKE_LINKER}" "-DOBJCOPY=${CMAKE_OBJCOPY}" "-DAR=${CMAKE_AR}"
          -P "${CMAKE_CURRENT_LIST_DIR}/${strip}.cmake"
  DEPENDS ${names} ${headers} "${CMAKE_CURRENT_LIST_DIR}/${strip}.cmake" "${CMAKE_CURRENT_LIST_DIR}/functions.cmake"
    "${CMAKE_CURRENT_LIST_DIR}/run.cmake"
  COMMENT "Stripping the libraries" VERBATIM)
add_custom_target(deldrift_stripped ALL DEPENDS ${made})

set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/deldrift")
configure_package_config_file(cmake/deldriftConfig.cmake.in deldriftConfig.cmake
  INSTALL_DESTINATION "${package_dir}" PATH_VARS CMAKE_INSTALL_INCLUDEDIR CMAKE_INSTALL_LIBDIR)
write_basic_package_version_file(deldriftConfigVersion.cmake COMPATIBILITY ${compatibility})

# Paths are given from the folder of the .pc file, so that an installation may be moved as a whole.
set(pkgconfig_dir "${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig")
file(RELATIVE_PATH prefix "${pkgconfig_dir}" "${CMAKE_INSTALL_PREFIX}")
file(RELATIVE_PATH DELDRIFT_PC_INCLUDEDIR "${CMAKE_INSTALL_PREFIX}" "${CMAKE_INSTALL_FULL_INCLUDEDIR}")
file(RELATIVE_PATH DELDRIFT_PC_LIBDIR "${CMAKE_INSTALL_PREFIX}" "${CMAKE_INSTALL_FULL_LIBDIR}")
string(REGEX REPLACE "/$" "" DELDRIFT_PC_PREFIX "\${pcfiledir}/${prefix}")
list(TRANSFORM DELDRIFT_SYSTEM_LIBRARIES PREPEND "-l" OUTPUT_VARIABLE DELDRIFT_LINK_FLAGS)
string(JOIN " " DELDRIFT_LINK_FLAGS ${DELDRIFT_LINK_FLAGS})
configure_file(deldrift.pc.in deldrift.pc @ONLY)

install(DIRECTORY include/ DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" COMPONENT deldrift
  FILES_MATCHING PATTERN "*.h" PATTERN "*.hpp")
install(FILES "${stripped}/libdeldrift.a" DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT deldrift)
if(WIN32)
  install(PROGRAMS "${stripped}/deldrift.dll" DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT deldrift_runtime)
  install(FILES "${stripped}/libdeldrift.dll.a" "${stripped}/deldrift.def" DESTINATION "${CMAKE_INSTALL_LIBDIR}"
    COMPONENT deldrift)
else()
  # Debian's libraries are not executable; elsewhere they are by custom.
  set(kind_of_file PROGRAMS)
  if(CMAKE_INSTALL_SO_NO_EXE)
    set(kind_of_file FILES)
  endif()
  install(${kind_of_file} "${stripped}/libdeldrift.so" DESTINATION "${CMAKE_INSTALL_LIBDIR}"
    COMPONENT deldrift_runtime RENAME "${DELDRIFT_FILE}")
  # The loader looks for the first name, the linker for the other one.
  file(MAKE_DIRECTORY "${PROJECT_BINARY_DIR}/links")
  foreach(link IN ITEMS "${DELDRIFT_SONAME}" libdeldrift.so)
    file(CREATE_LINK "${DELDRIFT_FILE}" "${PROJECT_BINARY_DIR}/links/${link}" SYMBOLIC)
  endforeach()
  install(FILES "${PROJECT_BINARY_DIR}/links/${DELDRIFT_SONAME}" DESTINATION "${CMAKE_INSTALL_LIBDIR}"
    COMPONENT deldrift_runtime)
  install(FILES "${PROJECT_BINARY_DIR}/links/libdeldrift.so" DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT deldrift)
endif()
install(FILES "${PROJECT_BINARY_DIR}/deldriftConfig.cmake" "${PROJECT_BINARY_DIR}/deldriftConfigVersion.cmake"
  DESTINATION "${package_dir}" COMPONENT deldrift)
install(FILES LICENSE-MIT LICENSE-APACHE cmake/copyright DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT deldrift)
install(FILES "${PROJECT_BINARY_DIR}/deldrift.pc" DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig" COMPONENT deldrift)
