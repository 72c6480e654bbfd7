# deldrift on several processes: libdeldrift_mpi, shared (component deldrift_mpi_runtime) and static, its header, and files
# for CMake and pkg-config (deldrift_mpi).
if(is_top_level AND NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()
add_subdirectory(mpi)

set(DELDRIFT_MPI_DOCDIR "${CMAKE_INSTALL_DATAROOTDIR}/doc/deldrift-mpi" CACHE STRING
  "Where the documentation of the component deldrift_mpi is installed")
configure_package_config_file(cmake/deldriftMpi.cmake.in deldriftMpi.cmake
  INSTALL_DESTINATION "${package_dir}" PATH_VARS CMAKE_INSTALL_INCLUDEDIR CMAKE_INSTALL_LIBDIR
  NO_CHECK_REQUIRED_COMPONENTS_MACRO)
configure_file(deldrift-mpi.pc.in deldrift-mpi.pc @ONLY)
install(FILES "${PROJECT_BINARY_DIR}/deldriftMpi.cmake" DESTINATION "${package_dir}" COMPONENT deldrift_mpi)
install(FILES "${PROJECT_BINARY_DIR}/deldrift-mpi.pc" DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig"
  COMPONENT deldrift_mpi)
install(FILES cmake/copyright docs/MPI.md DESTINATION "${DELDRIFT_MPI_DOCDIR}" COMPONENT deldrift_mpi)
