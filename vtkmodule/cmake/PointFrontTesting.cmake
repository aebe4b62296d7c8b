# What every test of the project shares: where data are, how a test is named, where it draws.

set(POINTFRONT_SHARED_DATA "${CMAKE_SOURCE_DIR}/../shared/data" CACHE PATH
  "The folder of public test clouds; tests that need it fail without it")
set(POINTFRONT_TEST_DATA "${CMAKE_SOURCE_DIR}/Testing/Data")
set(POINTFRONT_TEST_PREFIX "" CACHE STRING
  "Put before every test's name, so that the tests of several build trees can run as one")
# The kernel compiled for ParaView is the kernel compiled for VTK: its tests need not run twice.
option(POINTFRONT_TEST_KERNEL "Test the kernel, the readers and the tool" ON)

find_program(POINTFRONT_XVFB_RUN xvfb-run)

# Where tests write: a folder for each build tree, since the same tests of several trees run at one
# time, and one for each program that draws.
set(pointfront_test_files "${CMAKE_BINARY_DIR}/Testing/Files")
file(MAKE_DIRECTORY "${pointfront_test_files}")

# pointfront_discover_tests(<executable> <as gtest_discover_tests>...)
macro (pointfront_discover_tests)
  gtest_discover_tests(${ARGN} PROPERTIES ENVIRONMENT "TEST_TMPDIR=${pointfront_test_files}")
endmacro ()

# pointfront_add_display_test(NAME <name> COMMAND <command> [<argument>...])
# A test that opens a window. It draws on an X server of its own, in software: the same pictures on
# every machine, with or without a screen. -noreset keeps the server when its last window closes.
function (pointfront_add_display_test)
  cmake_parse_arguments(PARSE_ARGV 0 test "" "NAME" "COMMAND")
  if (NOT POINTFRONT_XVFB_RUN)
    message(FATAL_ERROR
      "xvfb-run is missing: run scripts/setup, or set POINTFRONT_BUILD_TESTING=OFF")
  endif ()
  add_test(NAME "${POINTFRONT_TEST_PREFIX}${test_NAME}"
    COMMAND "${POINTFRONT_XVFB_RUN}" -a -s "-screen 0 1280x1024x24 -noreset" ${test_COMMAND})
  file(MAKE_DIRECTORY "${pointfront_test_files}/${test_NAME}")
  set_tests_properties("${POINTFRONT_TEST_PREFIX}${test_NAME}" PROPERTIES
    ENVIRONMENT "LIBGL_ALWAYS_SOFTWARE=1;TEST_TMPDIR=${pointfront_test_files}/${test_NAME}")
endfunction ()

# pointfront_name_leaks(<executable>)
# For programs that open a window: LeakSanitizer then knows where the driver's memory belongs.
function (pointfront_name_leaks executable)
  if (POINTFRONT_SANITIZE MATCHES "address")
    target_sources(${executable} PRIVATE
      "${CMAKE_SOURCE_DIR}/Testing/Support/LibrariesStayOpen.cxx")
  endif ()
endfunction ()

# pointfront_add_module_test(<executable> MODULES <module>... [SUITES <suite>...])
# One executable of all Cxx/*.cxx of the calling folder. With SUITES its tests draw: each is one
# test on an X server; without, each test is found by itself.
function (pointfront_add_module_test name)
  cmake_parse_arguments(PARSE_ARGV 1 test "" "" "MODULES;SUITES")
  find_package(GTest REQUIRED)
  include(GoogleTest)
  file(GLOB sources CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/Cxx/*.cxx")
  add_executable(${name} ${sources})
  pointfront_compile_by_folder(${name})
  target_include_directories(${name} PRIVATE "${CMAKE_CURRENT_SOURCE_DIR}/Cxx"
    "${CMAKE_SOURCE_DIR}/vtkmodule/Core/Testing" "${CMAKE_SOURCE_DIR}/Testing/Support")
  target_link_libraries(${name} PRIVATE ${test_MODULES} pointfrontWarnings GTest::gtest_main)
  vtk_module_autoinit(TARGETS ${name} MODULES ${test_MODULES})
  if (test_SUITES)
    pointfront_name_leaks(${name})
    foreach (suite IN LISTS test_SUITES)
      pointfront_add_display_test(NAME "${name}.${suite}"
        COMMAND "$<TARGET_FILE:${name}>" "--gtest_filter=${suite}.*")
    endforeach ()
  else ()
    pointfront_discover_tests(${name} TEST_PREFIX "${POINTFRONT_TEST_PREFIX}${name}."
      DISCOVERY_TIMEOUT 60)
  endif ()
endfunction ()
