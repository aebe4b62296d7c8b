# The VTK modules, built against the host's VTK; Python wrapping; the ParaView plugin.

# A folder with a vtk.module file is a module: found, not listed.
vtk_module_find_modules(pointfront_module_files
  "${CMAKE_CURRENT_SOURCE_DIR}/vtkmodule/Common"
  "${CMAKE_CURRENT_SOURCE_DIR}/IO"
  "${CMAKE_CURRENT_SOURCE_DIR}/Filters"
  "${CMAKE_CURRENT_SOURCE_DIR}/Rendering")
if (POINTFRONT_HOST STREQUAL "ParaView")
  vtk_module_find_modules(pointfront_paraview_files "${CMAKE_CURRENT_SOURCE_DIR}/paraview-plugin")
  list(APPEND pointfront_module_files ${pointfront_paraview_files})
endif ()

vtk_module_scan(
  MODULE_FILES ${pointfront_module_files}
  PROVIDES_MODULES pointfront_modules
  REQUIRES_MODULES pointfront_required_modules
  WANT_BY_DEFAULT ON
  ENABLE_TESTS OFF)
# VTK's own build gives its modules a header that its package does not give to ours: the one that
# the Module.h of a module with implementations elsewhere includes.
set_property(GLOBAL PROPERTY _vtk_module_autoinit_include "\"vtkAutoInit.h\"")
vtk_module_build(
  MODULES ${pointfront_modules}
  PACKAGE PointFront
  INSTALL_EXPORT PointFront
  INSTALL_HEADERS ON
  HEADERS_DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/pointfront-vtk"
  CMAKE_DESTINATION "${CMAKE_INSTALL_LIBDIR}/cmake/PointFront"
  LIBRARY_NAME_SUFFIX ""
  VERSION "${PROJECT_VERSION}"
  SOVERSION "${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}"
  HEADERS_COMPONENT Development
  TARGETS_COMPONENT "${pointfront_modules_component}"
  USE_EXTERNAL OFF)

if (POINTFRONT_HOST STREQUAL "ParaView")
  paraview_plugin_scan(
    PLUGIN_FILES "${CMAKE_CURRENT_SOURCE_DIR}/paraview-plugin/paraview.plugin"
    PROVIDES_PLUGINS pointfront_plugins
    REQUIRES_MODULES pointfront_plugin_modules
    ENABLE_BY_DEFAULT ON)
  paraview_plugin_build(
    PLUGINS ${pointfront_plugins}
    TARGET PointFront::paraview_plugins
    INSTALL_EXPORT PointFrontPlugins
    CMAKE_DESTINATION "${CMAKE_INSTALL_LIBDIR}/cmake/PointFront"
    LIBRARY_SUBDIRECTORY "${PARAVIEW_PLUGIN_SUBDIR}"
    PLUGINS_FILE_NAME "pointfront.xml")
elseif (POINTFRONT_WRAP_PYTHON)
  set(Python3_ARTIFACTS_INTERACTIVE 1)
  find_package(Python3 EXACT ${VTK_PYTHON_VERSION} REQUIRED
    COMPONENTS Interpreter Development.Module)
  vtk_module_wrap_python(
    MODULES ${pointfront_modules}
    INSTALL_EXPORT PointFrontPython
    INSTALL_HEADERS ON
    PYTHON_PACKAGE "pointfront"
    MODULE_DESTINATION "${pointfront_python_folder}"
    CMAKE_DESTINATION "${CMAKE_INSTALL_LIBDIR}/cmake/PointFront"
    BUILD_STATIC OFF
    COMPONENT "${pointfront_python_component}"
    TARGET PointFront::pythonmodules)
endif ()

# Tests of the modules: after all of them, for they link several.
if (POINTFRONT_BUILD_TESTING)
  foreach (folder IN ITEMS vtkmodule/Common IO/Store IO/LAS/Index Filters/Build Filters/Extract
      Rendering/OpenGL2)
    add_subdirectory("${CMAKE_CURRENT_SOURCE_DIR}/${folder}/Testing")
  endforeach ()
endif ()
