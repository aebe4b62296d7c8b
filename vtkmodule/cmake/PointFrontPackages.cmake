# Third-party libraries, each found once, here.

find_package(Threads REQUIRED)
find_package(glm REQUIRED)
find_package(zstd CONFIG REQUIRED)           # zstd::libzstd_shared
find_package(meshoptimizer CONFIG REQUIRED)  # meshoptimizer::meshoptimizer
find_package(nlohmann_json REQUIRED)
find_package(CLI11 CONFIG REQUIRED)
find_package(LASzip REQUIRED)                # LASzip::LASzip
find_package(PROJ CONFIG REQUIRED)           # PROJ::proj

# VTK first: a find_package(Python3) before it would find another Python than Debian's.
if (POINTFRONT_HOST STREQUAL "VTK")
  find_package(VTK 9.1 REQUIRED COMPONENTS
    CommonCore CommonDataModel CommonExecutionModel CommonMath CommonTransforms
    FiltersCore ImagingCore InteractionStyle IOImage
    RenderingAnnotation RenderingCore RenderingOpenGL2 RenderingUI TestingRendering glew opengl
    WrappingPythonCore Python WrappingTools)
elseif (POINTFRONT_HOST STREQUAL "ParaView")
  # Debian's package config works through the shadow prefix that scripts/paraview-prefix makes.
  file(GLOB pointfront_paraview_prefix
    "${CMAKE_CURRENT_SOURCE_DIR}/.deps/paraview/usr/lib/*/cmake/paraview-*")
  find_package(ParaView 5.11 COMPONENTS RemotingCore RemotingViews RemotingServerManager
    RemotingClientServerStream VTKExtensionsCore WrapClientServer ProcessXML
    HINTS ${pointfront_paraview_prefix})
  if (NOT ParaView_FOUND)
    message(FATAL_ERROR "ParaView 5.11 is not usable: ${ParaView_NOT_FOUND_MESSAGE}\n"
      "On Debian run scripts/paraview-prefix first; elsewhere set ParaView_DIR.")
  endif ()
endif ()
