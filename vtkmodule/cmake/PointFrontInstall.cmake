# Installation of what is not a VTK module, and the CMake package `PointFront`.
# Exports: PointFrontKernel (Core, IO*: plain C++), PointFront (VTK modules, see PointFrontModules).
include(CMakePackageConfigHelpers)
set(pointfront_package_folder "${CMAKE_INSTALL_LIBDIR}/cmake/PointFront")

include(PointFrontPublicHeaders)
pointfront_install_headers()
set(pointfront_kernel_libraries pointfrontCore pointfrontSourceFormats pointfrontAttributePasses
  pointfrontSoftware)
foreach (library IN ITEMS IOEPT IOLAS IOPCD IOPLY IOPNG IORemote IOSTAC IOStyleJSON IOText
    FiltersAttributes FiltersNormals FiltersProjection)
  if (TARGET pointfront${library}) # not left out of this build
    list(APPEND pointfront_kernel_libraries pointfront${library})
  endif ()
endforeach ()
install(TARGETS ${pointfront_kernel_libraries} EXPORT PointFrontKernel
  RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT Runtime
  LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT Runtime NAMELINK_COMPONENT Development
  ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT Development)
if (TARGET pointfrontFiltersImageColor) # a package of its own: OpenImageIO brings 260 libraries
  install(TARGETS pointfrontFiltersImageColor EXPORT PointFrontKernel
    LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT Images
      NAMELINK_COMPONENT Development)
endif ()
install(EXPORT PointFrontKernel NAMESPACE PointFront:: FILE PointFrontKernel-targets.cmake
  DESTINATION "${pointfront_package_folder}" COMPONENT Development)
export(EXPORT PointFrontKernel NAMESPACE PointFront::
  FILE "${CMAKE_BINARY_DIR}/${pointfront_package_folder}/PointFrontKernel-targets.cmake")

if (NOT POINTFRONT_WHEEL) # its metadata have them
  install(FILES "${CMAKE_CURRENT_SOURCE_DIR}/LICENSE" "${CMAKE_CURRENT_SOURCE_DIR}/CHANGELOG.md"
    DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT Runtime)
  include(PointFrontDebian)
endif ()

# Pages of the public headers: plain C++, and the classes for VTK.
find_package(Doxygen QUIET)
if (DOXYGEN_FOUND)
  file(GLOB pointfront_documented CONFIGURE_DEPENDS
    "${CMAKE_CURRENT_SOURCE_DIR}/*/*/vtkPointFront*.h"
    "${CMAKE_CURRENT_SOURCE_DIR}/IO/LAS/Index/vtkPointFront*.h")
  list(APPEND pointfront_documented ${pointfront_public_headers})
  set(DOXYGEN_PROJECT_NAME PointFront)
  set(DOXYGEN_STRIP_FROM_PATH "${CMAKE_CURRENT_SOURCE_DIR}/vtkmodule/Core"
    "${CMAKE_CURRENT_SOURCE_DIR}")
  set(DOXYGEN_JAVADOC_AUTOBRIEF YES)
  set(DOXYGEN_GENERATE_LATEX NO)
  set(DOXYGEN_QUIET YES)
  set(DOXYGEN_WARN_IF_UNDOCUMENTED NO) # a name that says all needs no sentence
  set(DOXYGEN_WARN_AS_ERROR FAIL_ON_WARNINGS)
  set(DOXYGEN_PREDEFINED "VTK_WRAPEXTERN=")
  doxygen_add_docs(docs ${pointfront_documented} COMMENT "Pages of the public headers")
endif ()

# The package names exactly what it was built with: VTK's C++ interface changes between releases.
set(pointfront_vtk_version "")
if (NOT POINTFRONT_HOST STREQUAL "NONE")
  set(pointfront_vtk_version "${VTK_VERSION}") # with ParaView: of ParaView's own VTK
endif ()
configure_package_config_file(
  "${CMAKE_CURRENT_LIST_DIR}/PointFrontConfig.cmake.in"
  "${CMAKE_BINARY_DIR}/${pointfront_package_folder}/PointFrontConfig.cmake"
  INSTALL_DESTINATION "${pointfront_package_folder}"
  PATH_VARS pointfront_python_folder)
write_basic_package_version_file(
  "${CMAKE_BINARY_DIR}/${pointfront_package_folder}/PointFrontConfigVersion.cmake"
  COMPATIBILITY SameMinorVersion)
install(FILES
  "${CMAKE_BINARY_DIR}/${pointfront_package_folder}/PointFrontConfig.cmake"
  "${CMAKE_BINARY_DIR}/${pointfront_package_folder}/PointFrontConfigVersion.cmake"
  "${CMAKE_CURRENT_LIST_DIR}/FindLASzip.cmake"
  DESTINATION "${pointfront_package_folder}" COMPONENT Development)

# The Python package: VTK's wrapping makes one extension module for each VTK module, this the rest.
if (POINTFRONT_HOST STREQUAL "VTK" AND POINTFRONT_WRAP_PYTHON)
  set(from "${CMAKE_CURRENT_SOURCE_DIR}/vtkmodule/Python")
  set(to "${CMAKE_BINARY_DIR}/${pointfront_python_folder}/pointfront")
  file(RELATIVE_PATH pointfront_tool_path "/${pointfront_python_folder}/pointfront"
    "/${CMAKE_INSTALL_BINDIR}/pointfront")
  set(package_files _version.py _host.py)
  foreach (file IN LISTS package_files)
    configure_file("${from}/${file}.in" "${to}/${file}" @ONLY)
  endforeach ()
  foreach (file IN ITEMS __init__.py __init__.pyi __main__.py _arrays.py _bucket.py _calls.py
      _classes.py _clouds.py _cluster.py _controls.py _doors.py _errors.py _extracts.py _far.py
      _gate.py
      _kernel.py _lines.py _meshes.py _orbit.py _page.py _pictures.py _plotting.py _progress.py
      _queries.py _remote.py _serve.py _steps.py _stream.py _window.py py.typed)
    configure_file("${from}/${file}" "${to}/${file}" COPYONLY)
    list(APPEND package_files "${file}")
  endforeach ()
  list(TRANSFORM package_files PREPEND "${to}/")
  install(FILES ${package_files} DESTINATION "${pointfront_python_folder}/pointfront"
    COMPONENT "${pointfront_python_component}")
  if (POINTFRONT_BUILD_TESTING)
    set(python_tests Controls Gate Package Points Refusals Waiting Without_VTK Writing)
    if (POINTFRONT_REMOTE)
      list(APPEND python_tests Addresses)
    endif ()
    execute_process(COMMAND "${Python3_EXECUTABLE}" -c "import distributed, psutil"
      RESULT_VARIABLE no_distributed OUTPUT_QUIET ERROR_QUIET)
    if (no_distributed OR NOT POINTFRONT_NORMALS)
      pointfront_leave_out("Python.Cluster")
      message(STATUS "Python.Cluster is left out: it needs Python packages distributed and psutil "
        "(Debian: python3-distributed) and POINTFRONT_NORMALS")
    else ()
      add_test(NAME Python.Cluster
        COMMAND "${CMAKE_COMMAND}" -E env
          "PYTHONPATH=${CMAKE_BINARY_DIR}/${pointfront_python_folder}"
          "${Python3_EXECUTABLE}" -B "${from}/Testing/test_cluster.py")
    endif ()
    execute_process(COMMAND "${Python3_EXECUTABLE}" -c "import boto3, distributed"
      RESULT_VARIABLE no_boto3 OUTPUT_QUIET ERROR_QUIET)
    if (no_boto3 OR NOT POINTFRONT_NORMALS OR NOT POINTFRONT_REMOTE)
      pointfront_leave_out("Python.Bucket")
      message(STATUS "Python.Bucket is left out: it needs Python packages boto3 and distributed "
        "(Debian: python3-boto3, python3-distributed), POINTFRONT_NORMALS and POINTFRONT_REMOTE")
    else ()
      add_test(NAME Python.Bucket
        COMMAND "${CMAKE_COMMAND}" -E env
          "PYTHONPATH=${CMAKE_BINARY_DIR}/${pointfront_python_folder}"
          "${Python3_EXECUTABLE}" -B "${from}/Testing/test_bucket.py")
    endif ()
    foreach (name IN LISTS python_tests)
      string(TOLOWER "${name}" test)
      pointfront_add_data_test(NAME Python.${name}
        COMMAND "${CMAKE_COMMAND}" -E env
          "PYTHONPATH=${CMAKE_BINARY_DIR}/${pointfront_python_folder}"
          "POINTFRONT_SHARED_DATA=${POINTFRONT_SHARED_DATA}"
          "${Python3_EXECUTABLE}" -B "${from}/Testing/test_${test}.py")
    endforeach ()
    pointfront_add_display_test(NAME Python.Files
      COMMAND "${CMAKE_COMMAND}" -E env
        "PYTHONPATH=${CMAKE_BINARY_DIR}/${pointfront_python_folder}"
        "${Python3_EXECUTABLE}" -B "${from}/Testing/test_files.py")
  endif ()
endif ()

# A wheel has these besides: its command, and PROJ's coordinate systems, which no system gives it.
if (POINTFRONT_WHEEL)
  install(FILES "${CMAKE_CURRENT_SOURCE_DIR}/vtkmodule/Python/pointfront_tool.py" DESTINATION "."
    COMPONENT Runtime)
  find_file(POINTFRONT_PROJ_DATABASE proj.db PATH_SUFFIXES share/proj proj REQUIRED
    HINTS "${PROJ_DIR}/../../.." "${PROJ_DIR}/../../../.." PATHS /usr /usr/local)
  install(FILES "${POINTFRONT_PROJ_DATABASE}" DESTINATION "${CMAKE_INSTALL_LIBDIR}/proj"
    COMPONENT Runtime)
endif ()
