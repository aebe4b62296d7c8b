# Debian packages, by cpack: of the tool, images, VTK modules, Python and headers; in a build for
# ParaView one with the plugin. scripts/deb builds, checks and installs them.

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME pointfront)
set(CPACK_PACKAGE_VENDOR "PointFront")
set(CPACK_PACKAGE_CONTACT "The PointFront authors <authors@pointfront.invalid>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "point clouds larger than memory")
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS "${CMAKE_LIBRARY_OUTPUT_DIRECTORY}")
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS_POLICY "=")
set(CPACK_PACKAGING_INSTALL_PREFIX "/usr")
set(CPACK_POINTFRONT_LICENCE "${CMAKE_CURRENT_SOURCE_DIR}/LICENSE") # for that script
set(CPACK_PRE_BUILD_SCRIPTS "${CMAKE_CURRENT_LIST_DIR}/PointFrontDebianFiles.cmake")
set(CPACK_POST_BUILD_SCRIPTS "${CMAKE_CURRENT_LIST_DIR}/PointFrontDebianScripts.cmake")

# pointfront_debian_package(<component> NAME <name> SECTION <section> TEXT <lines of at most 78>
#   [DEPENDS <package>...] [SUGGESTS <package>...])
# Sets what cpack reads, in the caller's scope.
macro (pointfront_debian_package component)
  cmake_parse_arguments(package "" "NAME;SECTION;TEXT" "DEPENDS;SUGGESTS" ${ARGN})
  string(TOUPPER "${component}" upper)
  list(APPEND CPACK_COMPONENTS_ALL ${component})
  list(JOIN package_DEPENDS ", " CPACK_DEBIAN_${upper}_PACKAGE_DEPENDS)
  list(JOIN package_SUGGESTS ", " CPACK_DEBIAN_${upper}_PACKAGE_SUGGESTS)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME "${package_NAME}")
  set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION "${package_SECTION}")
  set(CPACK_DEBIAN_${upper}_DESCRIPTION "${package_TEXT}")
  if ("${component}" MATCHES "^(Runtime|Images|Modules)$") # they have libraries in /usr/lib
    set(CPACK_DEBIAN_${upper}_PACKAGE_CONTROL_EXTRA "${CMAKE_CURRENT_LIST_DIR}/debian/triggers")
  endif ()
  install(FILES "${CMAKE_CURRENT_SOURCE_DIR}/LICENSE" RENAME copyright
    DESTINATION "share/doc/${package_NAME}" COMPONENT ${component} EXCLUDE_FROM_ALL)
endmacro ()

set(pointfront_this_version "(= ${PROJECT_VERSION}-1)")
set(CPACK_COMPONENTS_ALL "")
if (POINTFRONT_HOST STREQUAL "ParaView")
  # ParaView's VTK is another than Debian's, and libraries for it have the same names: they lie in
  # a folder of their own, kernel and all.
  set(CPACK_PACKAGING_INSTALL_PREFIX "/usr/lib/paraview-pointfront")
  set(CPACK_COMPONENTS_GROUPING ALL_COMPONENTS_IN_ONE)
  set(CPACK_COMPONENTS_ALL Runtime Images Modules Unspecified)
  set(CPACK_DEBIAN_PACKAGE_NAME paraview-pointfront)
  set(CPACK_DEBIAN_PACKAGE_SECTION science)
  set(CPACK_DEBIAN_PACKAGE_DEPENDS "paraview")
  set(CPACK_DEBIAN_PACKAGE_DESCRIPTION "A ParaView plugin that opens point files and stores\n\
of any size and draws them in bounded memory. Load it with Tools, Manage\n\
Plugins, Load New: PointFront.so lies in /usr/lib/paraview-pointfront.")
  list(APPEND CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS
    "${CMAKE_LIBRARY_OUTPUT_DIRECTORY}/${PARAVIEW_PLUGIN_SUBDIR}/PointFront")
else ()
  pointfront_debian_package(Runtime NAME pointfront SECTION science
    SUGGESTS pointfront-images pointfront-vtk
    TEXT "The tool pointfront and its libraries. It reads LAS, LAZ, COPC, EPT, PLY, PCD\n\
and text, builds stores in bounded memory, draws them in software, and exports\n\
what a query selects.")
  pointfront_debian_package(Development NAME libpointfront-dev SECTION libdevel
    DEPENDS "pointfront ${pointfront_this_version}" libglm-dev
    TEXT "Headers and CMake package: what a program needs to be built against\n\
PointFront's libraries.")
  if (POINTFRONT_IMAGE_COLOR)
    pointfront_debian_package(Images NAME pointfront-images SECTION science
      DEPENDS "pointfront ${pointfront_this_version}"
      TEXT "The library that reads colours and values from georeferenced images while a\n\
store is built (pointfront build --color-from).")
    set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
      "${CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS}, pointfront-images ${pointfront_this_version}")
  endif ()
  if (POINTFRONT_HOST STREQUAL "VTK")
    pointfront_debian_package(Modules NAME pointfront-vtk SECTION libs
      DEPENDS "pointfront ${pointfront_this_version}"
      TEXT "Modules of VTK: reader, builder, mapper and filters, and what the tool\n\
draws with OpenGL by.")
    set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "${CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS}, \
pointfront-vtk ${pointfront_this_version}, libvtk9-dev")
    if (POINTFRONT_WRAP_PYTHON)
      pointfront_debian_package(Python NAME python3-pointfront SECTION python
        DEPENDS "pointfront-vtk ${pointfront_this_version}" python3 python3-vtk9 python3-numpy
        TEXT "The Python package pointfront: clouds, queries into NumPy arrays, pictures, and\n\
the classes for VTK.")
      set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA
        "${CMAKE_CURRENT_LIST_DIR}/debian/postinst" "${CMAKE_CURRENT_LIST_DIR}/debian/prerm")
    endif ()
  endif ()
endif ()
include(CPack)
