# What cpack makes of the installation: packages for Debian, one for each component (make deb), and an archive of all to be
# unpacked anywhere (make dist). Libraries that programs run with are packages of their own, named by their sonames.
set(CPACK_PACKAGE_NAME deldrift)
set(CPACK_PACKAGE_VENDOR "The deldrift developers")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Exact Delaunay triangulations of moving points")
set(about
  "Keeps the Delaunay triangulation of points in 2D and 3D while they move,"
  "exactly, and tells what changes from step to step.")
string(JOIN "\n" CPACK_PACKAGE_DESCRIPTION ${about})
set(CPACK_PACKAGE_FILE_NAME "deldrift-${PROJECT_VERSION}-linux-${CMAKE_SYSTEM_PROCESSOR}")
set(CPACK_STRIP_FILES OFF)
# Whatever the umask.
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL)
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "The deldrift developers" CACHE STRING "Who maintains the package for Debian")
# Needs what the shared libraries are linked with, and tells others what it takes to be linked with them.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

# A package of a component: its name, its section, what else it depends on, and its description.
function(add_package component name section depends)
  string(TOUPPER "${component}" upper)
  string(JOIN "\n" description ${ARGN})
  set(CPACK_COMPONENTS_ALL ${CPACK_COMPONENTS_ALL} ${component} PARENT_SCOPE)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${name} PARENT_SCOPE)
  set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION ${section} PARENT_SCOPE)
  set(CPACK_DEBIAN_${upper}_PACKAGE_DEPENDS "${depends}" PARENT_SCOPE)
  set(CPACK_DEBIAN_${upper}_FILE_NAME DEB-DEFAULT PARENT_SCOPE)
  set(CPACK_COMPONENT_${upper}_DESCRIPTION "${description}" PARENT_SCOPE)
endfunction()

# ... of one that has a shared library: what is after the name of the library in its soname ends the package's.
function(add_runtime_package component library depends)
  string(REPLACE "_" "-" name "${library}${DELDRIFT_INTERFACE}")
  set(control "${PROJECT_BINARY_DIR}/debian/${component}")
  file(WRITE "${control}/shlibs" "${library} ${DELDRIFT_INTERFACE} ${name} (>= ${PROJECT_VERSION})\n")
  file(WRITE "${control}/triggers" "activate-noawait ldconfig\n")
  string(TOUPPER "${component}" upper)
  set(CPACK_DEBIAN_${upper}_PACKAGE_CONTROL_EXTRA "${control}/shlibs" "${control}/triggers" PARENT_SCOPE)
  add_package(${component} "${name}" libs "${depends}" ${ARGN})
  foreach(variable IN ITEMS PACKAGE_NAME PACKAGE_SECTION PACKAGE_DEPENDS FILE_NAME)
    set(CPACK_DEBIAN_${upper}_${variable} "${CPACK_DEBIAN_${upper}_${variable}}" PARENT_SCOPE)
  endforeach()
  set(CPACK_COMPONENT_${upper}_DESCRIPTION "${CPACK_COMPONENT_${upper}_DESCRIPTION}" PARENT_SCOPE)
  set(CPACK_COMPONENTS_ALL ${CPACK_COMPONENTS_ALL} PARENT_SCOPE)
  # A package needs one of its own, an installation of all does not.
  install(FILES "${PROJECT_SOURCE_DIR}/cmake/copyright" DESTINATION "${CMAKE_INSTALL_DATAROOTDIR}/doc/${name}"
    COMPONENT ${component} EXCLUDE_FROM_ALL)
endfunction()

set(this_version "(= ${PROJECT_VERSION})")
set(of_interface "${DELDRIFT_INTERFACE}")
add_runtime_package(deldrift_runtime libdeldrift "" ${about}
  "This package has the shared library, which programs run with.")
add_package(deldrift libdeldrift-dev libdevel "libdeldrift${of_interface} ${this_version}" ${about}
  "This package has the static library, headers for C and C++, and files for"
  "CMake and pkg-config.")
if(DELDRIFT_COMPAT)
  add_runtime_package(deldrift_compat_runtime libdeldrift_triangle_tetgen ""
    "The functions by which programs call Triangle and TetGen, to be loaded before"
    "a program, or for programs that are linked with them.")
  # For the static library, which needs the other one.
  add_package(deldrift_compat libdeldrift-compat-dev libdevel
    "libdeldrift-triangle-tetgen${of_interface} ${this_version}, libdeldrift-dev ${this_version}"
    "The functions by which programs call Triangle and TetGen: headers, a static"
    "library, and files for CMake and pkg-config.")
  foreach(original IN ITEMS qhull GetFEM)
    string(TOLOWER "${original}" lower)
    if(TARGET deldrift_${lower})
      add_runtime_package(deldrift_${lower} libdeldrift_${lower} ""
        "The function by which programs have ${original} triangulate points, to be loaded"
        "before a program.")
    endif()
  endforeach()
endif()
if(DELDRIFT_MPI)
  # Where the library of the other package is that this one is linked with: it is not installed while packages are made.
  file(MAKE_DIRECTORY "${PROJECT_BINARY_DIR}/debian/libraries")
  file(CREATE_LINK "${stripped}/libdeldrift.so" "${PROJECT_BINARY_DIR}/debian/libraries/${DELDRIFT_SONAME}" SYMBOLIC)
  set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS "${PROJECT_BINARY_DIR}/debian/libraries")
  add_runtime_package(deldrift_mpi_runtime libdeldrift_mpi "libdeldrift${of_interface} (>= ${PROJECT_VERSION})"
    "One triangulation of vertices that are spread over the processes of an"
    "MPI program.")
  # Programs are compiled with the headers of MPI and of the other package.
  add_package(deldrift_mpi libdeldrift-mpi-dev libdevel
    "libdeldrift-mpi${of_interface} ${this_version}, libdeldrift-dev ${this_version}, libopenmpi-dev"
    "One triangulation of vertices that are spread over the processes of an"
    "MPI program: headers, a static library, and files for CMake and pkg-config.")
endif()
include(CPack)
