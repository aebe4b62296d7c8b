# Which headers of the plain C++ libraries are public: what a program that uses them includes.
# Others are internal. Installed are the public ones, and those that they include.

set(pointfront_public_core
  Base/Bounds.h Base/Error.h Base/Progress.h Base/Result.h
  Build/StoreBuilder.h
  Disk/FarSettings.h
  Export/OutputTarget.h Export/SourceExport.h Export/StoreExport.h
  Front/View.h
  Plan/FramePlan.h Plan/PlanParts.h
  Points/AttributePass.h Points/AttributeSchema.h Points/NormalAttribute.h Points/ObjectClass.h
  Points/PassChoice.h Points/PointBatch.h Points/PointFileOpener.h Points/PointSink.h
  Points/PointSource.h Points/QuantisationGrid.h Points/ScalarType.h Points/SplatRadius.h
  Query/BoxRegion.h Query/ConvexRegion.h Query/InputBox.h Query/LineCorridor.h
  Query/PlanarGeometry.h Query/PointQuery.h Query/PointsById.h Query/PolygonPrism.h
  Query/QueryPlan.h Query/Region.h Query/SphereRegion.h Query/StoredPoints.h Query/WellKnownText.h
  Reference/CoordinateSystems.h Reference/GeoKeys.h
  Statistics/PointStatistics.h
  Store/PointStore.h Store/StoreVerification.h Store/StoredCloud.h Tiles/StoredCloudFormats.h
  Style/ColourMap.h Style/FilterExpression.h Style/LayerStyle.h Style/PointColouring.h
  Style/PointFilter.h Style/QualityPreset.h Style/StandardColours.h Style/StyleLens.h
  Style/StyleSheet.h Style/TechniqueNames.h
  Tiles/TiledCloud.h
  Views/ViewFront.h)
set(pointfront_public_io
  EPT/EPTFormat.h EPT/EPTTree.h
  LAS/InPlace/COPCFile.h LAS/InPlace/IndexedLASFile.h LAS/InPlace/LASIndexing.h
  LAS/LASFormat.h LAS/LASWriter.h
  PCD/PCDFormat.h PCD/PCDWriter.h PLY/PLYFormat.h PLY/PLYWriter.h PNG/PNGReader.h PNG/PNGWriter.h
  StyleJSON/StyleJSON.h Text/TextFormat.h Text/XYZWriter.h)
set(pointfront_public_filters
  Attributes/HeightAboveGroundPass.h Attributes/LocalHeightPass.h
  ImageColor/ImageValuesPass.h
  Normals/NormalsPass.h Normals/ScanNormalsPass.h
  Projection/ProjCoordinateSystems.h Projection/ProjectedSink.h Projection/ProjectionPass.h)
set(pointfront_public_software
  PixelRectangle.h SoftwareComposition.h SoftwareRasteriser.h SoftwareTarget.h)

# pointfront_with_included(<out> <header>...)
# The headers, and all of ours that they include, directly or not: those of the kernel, and those
# of their own library, in whatever room of it. Paths are absolute.
function (pointfront_with_included out)
  set(core "${CMAKE_SOURCE_DIR}/vtkmodule/Core")
  set(waiting ${ARGN})
  set(seen "")
  while (waiting)
    list(POP_BACK waiting header)
    if (header IN_LIST seen)
      continue ()
    endif ()
    if (NOT EXISTS "${header}")
      message(FATAL_ERROR "a public header is not there: ${header}")
    endif ()
    list(APPEND seen "${header}")
    file(RELATIVE_PATH library "${CMAKE_SOURCE_DIR}" "${header}")
    string(REGEX REPLACE "^([^/]+/[^/]+)/.*" "${CMAKE_SOURCE_DIR}/\\1" library "${library}")
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${header}")
    file(STRINGS "${header}" lines REGEX "^#include \"")
    foreach (line IN LISTS lines)
      string(REGEX REPLACE "^#include \"([^\"]+)\".*" "\\1" name "${line}")
      file(GLOB places "${core}/${name}" "${library}/${name}" "${library}/*/${name}")
      list(APPEND waiting ${places})
    endforeach ()
  endwhile ()
  list(SORT seen)
  set(${out} "${seen}" PARENT_SCOPE)
endfunction ()

# pointfront_install_headers()
# Installs them; sets pointfront_public_headers, absolute, for the documentation.
function (pointfront_install_headers)
  set(core "${CMAKE_SOURCE_DIR}/vtkmodule/Core/pointfront")
  set(public ${pointfront_public_core})
  list(TRANSFORM public PREPEND "${core}/")
  foreach (family IN LISTS pointfront_public_io)
    list(APPEND public "${CMAKE_SOURCE_DIR}/IO/${family}")
  endforeach ()
  foreach (family IN LISTS pointfront_public_filters)
    get_filename_component(filter "${family}" DIRECTORY)
    if (TARGET pointfrontFilters${filter})
      list(APPEND public "${CMAKE_SOURCE_DIR}/Filters/${family}")
    endif ()
  endforeach ()
  foreach (header IN LISTS pointfront_public_software)
    list(APPEND public "${CMAKE_SOURCE_DIR}/Rendering/Software/${header}")
  endforeach ()
  set(pointfront_public_headers "${public}" PARENT_SCOPE)
  pointfront_with_included(installed ${public})
  foreach (header IN LISTS installed)
    get_filename_component(folder "${header}" DIRECTORY)
    if (header MATCHES "^${core}/")
      file(RELATIVE_PATH where "${core}" "${folder}")
    elseif (header MATCHES "/Rendering/Software/")
      set(where "")
    elseif (header MATCHES "/IO/")
      set(where "IO")
    else ()
      set(where "Filters")
    endif ()
    install(FILES "${header}" COMPONENT Development
      DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/pointfront/${where}")
  endforeach ()
endfunction ()
