# What cpack makes of the installation: packages for Debian, one for each component (make deb), and an archive of all to be
# unpacked anywhere (make dist).
set(CPACK_PACKAGE_NAME deldrift)
set(CPACK_PACKAGE_VENDOR "The deldrift developers")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Exact Delaunay triangulations of moving points")
string(JOIN "\n" CPACK_PACKAGE_DESCRIPTION
  "Keeps the Delaunay triangulation of points in 2D and 3D while they move,"
  "exactly, and tells what changes from step to step. This package has the"
  "shared and the static library, headers for C and C++, and files for CMake"
  "and pkg-config.")
set(CPACK_PACKAGE_FILE_NAME "deldrift-${PROJECT_VERSION}-linux-${CMAKE_SYSTEM_PROCESSOR}")
set(CPACK_STRIP_FILES OFF)
# Whatever the umask.
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL deldrift)
set(CPACK_DEBIAN_DELDRIFT_PACKAGE_NAME libdeldrift-dev)
set(CPACK_DEBIAN_DELDRIFT_FILE_NAME DEB-DEFAULT)
set(CPACK_COMPONENT_DELDRIFT_DESCRIPTION "${CPACK_PACKAGE_DESCRIPTION}")
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "The deldrift developers" CACHE STRING "Who maintains the package for Debian")
set(CPACK_DEBIAN_PACKAGE_SECTION libdevel)
# Needs what the shared library is linked with, and tells others what it takes to be linked with it.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
string(REPLACE ".so." " " soname_and_version "${DELDRIFT_SONAME}")
file(WRITE "${PROJECT_BINARY_DIR}/debian/shlibs" "${soname_and_version} libdeldrift-dev (>= ${PROJECT_VERSION})\n")
file(WRITE "${PROJECT_BINARY_DIR}/debian/triggers" "activate-noawait ldconfig\n")
set(CPACK_DEBIAN_DELDRIFT_PACKAGE_CONTROL_EXTRA
  "${PROJECT_BINARY_DIR}/debian/shlibs" "${PROJECT_BINARY_DIR}/debian/triggers")
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

if(DELDRIFT_COMPAT)
  list(APPEND CPACK_COMPONENTS_ALL deldrift_compat)
  set(CPACK_DEBIAN_DELDRIFT_COMPAT_PACKAGE_NAME libdeldrift-compat-dev)
  set(CPACK_DEBIAN_DELDRIFT_COMPAT_FILE_NAME DEB-DEFAULT)
  # For the static library, which needs the other one.
  set(CPACK_DEBIAN_DELDRIFT_COMPAT_PACKAGE_DEPENDS "libdeldrift-dev (= ${PROJECT_VERSION})")
  string(JOIN "\n" CPACK_COMPONENT_DELDRIFT_COMPAT_DESCRIPTION
    "The functions by which programs call Triangle and TetGen, to be linked or"
    "to be loaded before a program.")
  file(WRITE "${PROJECT_BINARY_DIR}/debian/compat/shlibs"
    "libdeldrift_triangle_tetgen ${DELDRIFT_INTERFACE} libdeldrift-compat-dev (>= ${PROJECT_VERSION})\n")
  file(WRITE "${PROJECT_BINARY_DIR}/debian/compat/triggers" "activate-noawait ldconfig\n")
  set(CPACK_DEBIAN_DELDRIFT_COMPAT_PACKAGE_CONTROL_EXTRA
    "${PROJECT_BINARY_DIR}/debian/compat/shlibs" "${PROJECT_BINARY_DIR}/debian/compat/triggers")
endif()
if(DELDRIFT_MPI)
  list(APPEND CPACK_COMPONENTS_ALL deldrift_mpi)
  set(CPACK_DEBIAN_DELDRIFT_MPI_PACKAGE_NAME libdeldrift-mpi-dev)
  set(CPACK_DEBIAN_DELDRIFT_MPI_FILE_NAME DEB-DEFAULT)
  # Programs are compiled with the headers of MPI and of the other package.
  set(CPACK_DEBIAN_DELDRIFT_MPI_PACKAGE_DEPENDS "libdeldrift-dev (= ${PROJECT_VERSION}), libopenmpi-dev")
  string(JOIN "\n" CPACK_COMPONENT_DELDRIFT_MPI_DESCRIPTION
    "One triangulation of vertices that are spread over the processes of an"
    "MPI program.")
  # Where the library of the other package is that this one is linked with: it is not installed while packages are made.
  file(MAKE_DIRECTORY "${PROJECT_BINARY_DIR}/debian/libraries")
  file(CREATE_LINK "${stripped}/libdeldrift.so" "${PROJECT_BINARY_DIR}/debian/libraries/${DELDRIFT_SONAME}" SYMBOLIC)
  set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS "${PROJECT_BINARY_DIR}/debian/libraries")
  file(WRITE "${PROJECT_BINARY_DIR}/debian/mpi/shlibs"
    "libdeldrift_mpi ${DELDRIFT_INTERFACE} libdeldrift-mpi-dev (>= ${PROJECT_VERSION})\n")
  file(WRITE "${PROJECT_BINARY_DIR}/debian/mpi/triggers" "activate-noawait ldconfig\n")
  set(CPACK_DEBIAN_DELDRIFT_MPI_PACKAGE_CONTROL_EXTRA
    "${PROJECT_BINARY_DIR}/debian/mpi/shlibs" "${PROJECT_BINARY_DIR}/debian/mpi/triggers")
endif()
include(CPack)
