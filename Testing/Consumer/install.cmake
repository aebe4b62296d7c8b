# cmake -DBUILD=<build tree> -DPREFIX=<prefix> -P install.cmake
# Installs into an empty prefix: what an older build left there must not help.
file(REMOVE_RECURSE "${PREFIX}")
execute_process(COMMAND "${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${PREFIX}"
  RESULT_VARIABLE result OUTPUT_QUIET)
if (NOT result EQUAL 0)
  message(FATAL_ERROR "installing ${BUILD} failed: ${result}")
endif ()
