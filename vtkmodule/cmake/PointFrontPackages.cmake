# Third-party libraries, each found once, here.

find_package(Threads REQUIRED)
find_package(glm REQUIRED)
find_package(zstd CONFIG REQUIRED)           # zstd::libzstd_shared
find_package(meshoptimizer CONFIG REQUIRED)  # meshoptimizer::meshoptimizer
find_package(nlohmann_json REQUIRED)
find_package(CLI11 CONFIG REQUIRED)
find_package(LASzip REQUIRED)                # LASzip::LASzip

# VTK first: a find_package(Python3) before it would find another Python than Debian's.
if (POINTFRONT_HOST STREQUAL "VTK")
  find_package(VTK 9.1 REQUIRED COMPONENTS CommonCore CommonDataModel CommonExecutionModel CommonMath
    CommonTransforms FiltersCore ImagingCore InteractionStyle IOImage RenderingAnnotation RenderingCore
    RenderingOpenGL2 RenderingUI TestingRendering glew opengl WrappingPythonCore Python WrappingTools)
elseif (POINTFRONT_HOST STREQUAL "ParaView")
  find_package(ParaView 5.11 REQUIRED COMPONENTS RemotingCore RemotingViews RemotingServerManager
    RemotingClientServerStream VTKExtensionsCore WrapClientServer ProcessXML)
endif ()
