# VTK's readers as target isostar_vtk, if they are found. Debian's libvtk9-dev depends on 770 MB of
# packages that reading does not need. scripts/setup.sh therefore installs the libraries and unpacks
# only the headers, into build/vtk.
find_package(VTK QUIET COMPONENTS IOXML IOLegacy)
if(VTK_FOUND)
  add_library(isostar_vtk INTERFACE)
  target_link_libraries(isostar_vtk INTERFACE VTK::IOXML VTK::IOLegacy)
  return()
endif()

file(GLOB folders LIST_DIRECTORIES true ${PROJECT_SOURCE_DIR}/build/vtk/usr/include/vtk-*)
foreach(folder ${folders})
  string(REGEX REPLACE ".*/vtk-" "" version ${folder})
  set(libraries)
  foreach(module IOXML IOLegacy CommonExecutionModel CommonDataModel CommonMath CommonCore)
    find_library(ISOSTAR_VTK_${module} NAMES libvtk${module}-${version}.so.1)
    list(APPEND libraries ${ISOSTAR_VTK_${module}})
  endforeach()
  if(NOT TARGET isostar_vtk AND NOT "${libraries}" MATCHES NOTFOUND)
    add_library(isostar_vtk INTERFACE)
    target_include_directories(isostar_vtk SYSTEM INTERFACE ${folder})
    target_link_libraries(isostar_vtk INTERFACE ${libraries})
  endif()
endforeach()
