# The calling conventions of Triangle and TetGen: libdeldrift_triangle_tetgen, shared (component deldrift_compat_runtime) and
# static, headers for programs that have none, and files for CMake and pkg-config (deldrift_compat). Those of qhull and
# GetFEM, where these are installed, are the components deldrift_qhull and deldrift_getfem.
if(is_top_level AND NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()
add_subdirectory(compat)

set(DELDRIFT_COMPAT_DOCDIR "${CMAKE_INSTALL_DATAROOTDIR}/doc/deldrift-compat" CACHE STRING
  "Where the documentation of the component deldrift_compat is installed")
configure_package_config_file(cmake/deldriftCompat.cmake.in deldriftCompat.cmake
  INSTALL_DESTINATION "${package_dir}" PATH_VARS CMAKE_INSTALL_INCLUDEDIR CMAKE_INSTALL_LIBDIR
  NO_CHECK_REQUIRED_COMPONENTS_MACRO)
configure_file(deldrift-compat.pc.in deldrift-compat.pc @ONLY)
install(FILES "${PROJECT_BINARY_DIR}/deldriftCompat.cmake" DESTINATION "${package_dir}" COMPONENT deldrift_compat)
install(FILES "${PROJECT_BINARY_DIR}/deldrift-compat.pc" DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig"
  COMPONENT deldrift_compat)
install(FILES cmake/copyright compat/README.md DESTINATION "${DELDRIFT_COMPAT_DOCDIR}" COMPONENT deldrift_compat)
