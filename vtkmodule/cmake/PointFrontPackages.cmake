# Third-party libraries, each found once, here.

find_package(Threads REQUIRED)
find_package(glm REQUIRED)
find_package(zstd CONFIG REQUIRED)           # zstd::libzstd_shared
find_package(nlohmann_json REQUIRED)
find_package(CLI11 CONFIG REQUIRED)
find_package(LASzip REQUIRED)                # LASzip::LASzip
find_package(PNG REQUIRED)                   # PNG::PNG
if (POINTFRONT_REMOTE)
  find_package(CURL 7.85 REQUIRED)             # CURL::libcurl
endif ()
if (POINTFRONT_PROJECTION)
  find_package(PROJ CONFIG REQUIRED)           # PROJ::proj
endif ()
if (POINTFRONT_IMAGE_COLOR)
  find_package(TIFF REQUIRED)                  # TIFF::TIFF
  find_package(OpenImageIO CONFIG REQUIRED)    # OpenImageIO::OpenImageIO
  # Debian's targets name a folder that is not there, which CMake refuses.
  foreach (target IN ITEMS OpenImageIO::OpenImageIO OpenImageIO::OpenImageIO_Util)
    get_target_property(folders ${target} INTERFACE_INCLUDE_DIRECTORIES)
    set(present "")
    foreach (folder IN LISTS folders)
      if (EXISTS "${folder}")
        list(APPEND present "${folder}")
      endif ()
    endforeach ()
    set_target_properties(${target} PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${present}")
  endforeach ()
endif ()

if (POINTFRONT_NORMALS)
  find_package(Eigen3 REQUIRED NO_MODULE)      # Eigen3::Eigen
  find_path(POINTFRONT_FLANN_INCLUDE flann/flann.hpp REQUIRED) # its headers only
  find_package(PkgConfig REQUIRED)
  pkg_check_modules(POINTFRONT_LZ4 REQUIRED IMPORTED_TARGET liblz4) # FLANN's headers call it
endif ()

# VTK first: a find_package(Python3) before it would find another Python than VTK's.
if (POINTFRONT_HOST STREQUAL "VTK")
  find_package(VTK 9.1 REQUIRED COMPONENTS
    CommonCore CommonDataModel CommonExecutionModel CommonMath CommonTransforms
    FiltersCore ImagingCore InteractionStyle IOImage
    RenderingAnnotation RenderingCore RenderingFreeType RenderingOpenGL2 RenderingUI
    WrappingPythonCore Python WrappingTools
    OPTIONAL_COMPONENTS glad glew opengl) # glad since VTK 9.4, the two others before
  # The Python package that VTK's own classes are in: vtkmodules, or another build's name.
  get_property(pointfront_vtk_package TARGET VTK::CommonCore
    PROPERTY INTERFACE_vtk_module_python_package)
  if (POINTFRONT_WHEEL) # VTK's libraries lie in its own package, beside ours
    list(APPEND CMAKE_INSTALL_RPATH "$ORIGIN/../${pointfront_vtk_package}")
  endif ()
elseif (POINTFRONT_HOST STREQUAL "ParaView")
  # Debian's package config works through the shadow prefix that scripts/paraview-prefix makes.
  file(GLOB pointfront_paraview_prefix
    "${CMAKE_CURRENT_SOURCE_DIR}/.deps/paraview/usr/lib/*/cmake/paraview-*")
  find_package(ParaView 5.11 COMPONENTS RemotingCore RemotingViews RemotingServerManager
    RemotingClientServerStream VTKExtensionsCore WrapClientServer ProcessXML
    OPTIONAL_COMPONENTS pqComponents # where there is a panel; with its Qt
    HINTS ${pointfront_paraview_prefix})
  if (NOT ParaView_FOUND)
    message(FATAL_ERROR "ParaView 5.11 is not usable: ${ParaView_NOT_FOUND_MESSAGE}\n"
      "On Debian run scripts/paraview-prefix first; elsewhere set ParaView_DIR.")
  endif ()
endif ()

# pcl_common and, for tests and benchmarks, pcl_features and pcl_search. In a function: PCL must not
# see VTK (it would bring Debian's into a build for ParaView, and Qt), and what it sets must not be
# seen here.
function (pointfront_find_pcl)
  set(CMAKE_DISABLE_FIND_PACKAGE_VTK ON)
  set(CMAKE_DISABLE_FIND_PACKAGE_MPI ON)
  set(VTK_FOUND 0)
  find_package(PCL 1.13 REQUIRED QUIET COMPONENTS common kdtree search features)
endfunction ()
if (POINTFRONT_PCL)
  pointfront_find_pcl()
endif ()
