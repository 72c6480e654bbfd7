# What cpack makes of the installation: a package for Debian (make deb), an archive to be unpacked anywhere (make dist).
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

set(CPACK_DEBIAN_PACKAGE_NAME libdeldrift-dev)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "The deldrift developers" CACHE STRING "Who maintains the package for Debian")
set(CPACK_DEBIAN_PACKAGE_SECTION libdevel)
# Needs what the shared library is linked with, and tells others what it takes to be linked with it.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
string(REPLACE ".so." " " soname_and_version "${DELDRIFT_SONAME}")
file(WRITE "${PROJECT_BINARY_DIR}/debian/shlibs" "${soname_and_version} libdeldrift-dev (>= ${PROJECT_VERSION})\n")
file(WRITE "${PROJECT_BINARY_DIR}/debian/triggers" "activate-noawait ldconfig\n")
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA
  "${PROJECT_BINARY_DIR}/debian/shlibs" "${PROJECT_BINARY_DIR}/debian/triggers")
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
include(CPack)
