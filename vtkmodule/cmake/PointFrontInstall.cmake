# Installation of what is not a VTK module, and the package config.
install(DIRECTORY "${CMAKE_CURRENT_SOURCE_DIR}/vtkmodule/Core/pointfront"
  DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" COMPONENT Development FILES_MATCHING PATTERN "*.h")
