# Every test of the project shares this: where data are, how a test is named, where it draws.

set(POINTFRONT_SHARED_DATA "${CMAKE_SOURCE_DIR}/../shared/data" CACHE PATH
  "The folder of public test clouds; tests that read it are left out without it")
set(pointfront_has_shared_data FALSE)
if (EXISTS "${POINTFRONT_SHARED_DATA}/MANIFEST.md")
  set(pointfront_has_shared_data TRUE)
endif ()
set(POINTFRONT_TEST_DATA "${CMAKE_SOURCE_DIR}/Testing/Data")
set(POINTFRONT_TEST_PREFIX "" CACHE STRING
  "Put before every test's name, so that the tests of several build trees can run as one")
# The kernel compiled for ParaView is the kernel compiled for VTK: its tests need not run twice.
option(POINTFRONT_TEST_KERNEL "Test the kernel, the readers and the tool" ON)

find_program(POINTFRONT_XVFB_RUN xvfb-run)

# Here, not in a function: the module keeps its script in a variable of the scope that includes it.
include(GoogleTest)

# Where tests write: a folder for each build tree, since the same tests of several trees run at one
# time, and one for each program that draws. Below it each process makes its own: OwnFolder.cxx.
set(pointfront_test_files "${CMAKE_BINARY_DIR}/Testing/Files")
file(MAKE_DIRECTORY "${pointfront_test_files}")

# pointfront_leave_out(<test>...)
# Tests that this configuration has not, because they read the public clouds.
function (pointfront_leave_out)
  list(TRANSFORM ARGN PREPEND "${POINTFRONT_TEST_PREFIX}")
  set_property(GLOBAL APPEND PROPERTY pointfront_tests_left_out ${ARGN})
endfunction ()

# pointfront_report_left_out()
# Says which tests are left out; scripts/test counts them from the file.
function (pointfront_report_left_out)
  get_property(names GLOBAL PROPERTY pointfront_tests_left_out)
  set(file "${CMAKE_BINARY_DIR}/tests-left-out.txt")
  list(LENGTH names count)
  if (count EQUAL 0)
    file(REMOVE "${file}")
    return ()
  endif ()
  list(JOIN names "\n" lines)
  file(WRITE "${file}" "${lines}\n")
  message(STATUS "${count} tests or groups of tests are left out: they read public clouds, and "
    "POINTFRONT_SHARED_DATA (${POINTFRONT_SHARED_DATA}) has none. Their names are in ${file}")
endfunction ()

# pointfront_suites(<executable> PREFIX <prefix> LEFT_OUT <patterns, a colon between>)
# A test for each suite of the executable. One for each test would start a process under a
# sanitizer some two thousand times.
function (pointfront_suites executable)
  cmake_parse_arguments(PARSE_ARGV 1 suites "" "PREFIX;LEFT_OUT" "")
  set(file "${CMAKE_CURRENT_BINARY_DIR}/${executable}-suites.cmake")
  set(lister "${PROJECT_SOURCE_DIR}/vtkmodule/cmake/ListSuites.cmake")
  add_custom_command(TARGET ${executable} POST_BUILD VERBATIM
    COMMAND "${CMAKE_COMMAND}" "-DPROGRAM=$<TARGET_FILE:${executable}>" "-DFILE=${file}"
      "-DPREFIX=${suites_PREFIX}" "-DLEFT_OUT=${suites_LEFT_OUT}"
      "-DFOLDER=${pointfront_test_files}" -P "${lister}")
  set_property(TARGET ${executable} APPEND PROPERTY LINK_DEPENDS "${lister}")
  set(including "${CMAKE_CURRENT_BINARY_DIR}/${executable}-include.cmake")
  file(WRITE "${including}" "if (EXISTS [==[${file}]==])\n  include([==[${file}]==])\n"
    "else ()\n  add_test([==[${executable}_is_not_built]==] NOT_BUILT)\nendif ()\n")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES "${including}")
endfunction ()

# pointfront_discover_tests(<executable> TEST_PREFIX <prefix> [READS_DATA <suite>.<test>...]
#   [WITHOUT_THREADS <suite>.<test>...] [SAME_THREADS <suite>.<test>...]
#   [MEASURES <suite>.<test>...] [WITHOUT_SANITIZERS <suite>.<test>...]
#   <as gtest_discover_tests>...)
# READS_DATA: those that read the public clouds, or patterns of such. A TEST_FILTER may only begin
# with "-".
# WITHOUT_THREADS: those of what runs in one thread and takes seconds under ThreadSanitizer, which
# has nothing to see in them: they are left out there.
# SAME_THREADS: those that run the threads of a test that stays, over other data: they are left out
# under ThreadSanitizer, too.
# MEASURES: those that measure times, counts or many pictures of code that other tests run, too. A
# sanitizer sees nothing else in them, and they take it a minute each: they are left out there.
# WITHOUT_SANITIZERS: those of what a sanitizer does itself, or forbids.
function (pointfront_discover_tests executable)
  cmake_parse_arguments(PARSE_ARGV 1
    test "" "TEST_PREFIX;TEST_FILTER;DISCOVERY_TIMEOUT"
    "READS_DATA;WITHOUT_THREADS;SAME_THREADS;MEASURES;WITHOUT_SANITIZERS")
  string(REGEX REPLACE "^-" "" left_out "${test_TEST_FILTER}")
  if (test_READS_DATA AND NOT pointfront_has_shared_data)
    list(APPEND left_out ${test_READS_DATA})
    string(LENGTH "${POINTFRONT_TEST_PREFIX}" length)
    string(SUBSTRING "${test_TEST_PREFIX}" ${length} -1 prefix)
    list(TRANSFORM test_READS_DATA PREPEND "${prefix}")
    pointfront_leave_out(${test_READS_DATA})
  endif ()
  if (POINTFRONT_SANITIZE STREQUAL "thread")
    list(APPEND left_out ${test_WITHOUT_THREADS} ${test_SAME_THREADS})
  endif ()
  if (POINTFRONT_SANITIZE)
    list(APPEND left_out ${test_MEASURES} ${test_WITHOUT_SANITIZERS})
  endif ()
  list(JOIN left_out ":" left_out)
  if (POINTFRONT_SANITIZE)
    pointfront_suites(${executable} PREFIX "${test_TEST_PREFIX}" LEFT_OUT "${left_out}")
    return ()
  endif ()
  set(filter "")
  if (left_out)
    set(filter "-${left_out}")
  endif ()
  gtest_discover_tests(${executable} TEST_PREFIX "${test_TEST_PREFIX}" TEST_FILTER "${filter}"
    DISCOVERY_TIMEOUT ${test_DISCOVERY_TIMEOUT} ${test_UNPARSED_ARGUMENTS}
    PROPERTIES ENVIRONMENT "TEST_TMPDIR=${pointfront_test_files}")
endfunction ()

# pointfront_add_data_test(NAME <name> COMMAND <command> [<argument>...])
# As add_test(), of a test that reads the public clouds. The prefix of tests is put before the name.
function (pointfront_add_data_test)
  cmake_parse_arguments(PARSE_ARGV 0 test "" "NAME" "COMMAND")
  if (pointfront_has_shared_data)
    add_test(NAME "${POINTFRONT_TEST_PREFIX}${test_NAME}" COMMAND ${test_COMMAND})
  else ()
    pointfront_leave_out("${test_NAME}")
  endif ()
endfunction ()

# pointfront_add_display_test(NAME <name> [READS_DATA] COMMAND <command> [<argument>...])
# A test that opens a window. It draws on an X server of its own, in software: the same pictures on
# every machine, with or without a screen. -noreset keeps the server when its last window closes.
function (pointfront_add_display_test)
  cmake_parse_arguments(PARSE_ARGV 0 test "READS_DATA" "NAME" "COMMAND")
  if (test_READS_DATA AND NOT pointfront_has_shared_data)
    pointfront_leave_out("${test_NAME}")
    return ()
  endif ()
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

# pointfront_test_program(<executable>)
# How programs of tests are compiled: by folder, and without the costly optimisations, since nobody
# waits for a test's own code. -O1 compiles in two thirds of the time of -O3.
# AddressSanitizer and UB Sanitizer check the libraries, not the tests, which are compiled as those
# of the preset `release` are: ccache then compiles them once for both. (ThreadSanitizer has to see
# every access.)
function (pointfront_test_program executable)
  pointfront_compile_by_folder(${executable} TESTS)
  target_sources(${executable} PRIVATE "${CMAKE_SOURCE_DIR}/Testing/Support/OwnFolder.cxx")
  if (POINTFRONT_SANITIZE MATCHES "address")
    get_target_property(options ${executable} COMPILE_OPTIONS)
    list(REMOVE_ITEM options ${pointfront_sanitizing})
    set_property(TARGET ${executable} PROPERTY COMPILE_OPTIONS "${options}")
  endif ()
  target_compile_options(${executable} PRIVATE
    $<$<AND:$<CXX_COMPILER_ID:GNU,Clang,AppleClang>,$<CONFIG:Release>>:-O1>)
endfunction ()

# pointfront_add_unit_tests(<library> PREFIX <prefix> [KNOWS_DATA] [ONE_THREAD] LINK <library>...
#   [SOURCES <file>...] [INCLUDE <folder>...] [DISCOVER <as pointfront_discover_tests>...])
# The executable pointfront<library>Tests of all *.cxx of the calling folder, or of SOURCES.
# ONE_THREAD: library and tests start no thread: nothing is built for ThreadSanitizer.
# KNOWS_DATA: it is told where the public clouds are; a path in every command line keeps ccache from
# sharing between checkouts.
function (pointfront_add_unit_tests library)
  cmake_parse_arguments(PARSE_ARGV 1
    test "KNOWS_DATA;ONE_THREAD" "PREFIX" "SOURCES;LINK;INCLUDE;DISCOVER")
  if (test_ONE_THREAD AND POINTFRONT_SANITIZE STREQUAL "thread")
    return ()
  endif ()
  find_package(GTest REQUIRED)
  if (NOT test_SOURCES)
    file(GLOB test_SOURCES CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/*.cxx")
  endif ()
  set(name "pointfront${library}Tests")
  add_executable(${name} ${test_SOURCES})
  pointfront_test_program(${name})
  target_link_libraries(${name} PRIVATE ${test_LINK} pointfrontWarnings GTest::gtest_main)
  target_include_directories(${name} PRIVATE
    "${CMAKE_CURRENT_SOURCE_DIR}" "${PROJECT_SOURCE_DIR}/Testing/Support" ${test_INCLUDE})
  if (test_KNOWS_DATA)
    target_compile_definitions(${name} PRIVATE POINTFRONT_SHARED_DATA="${POINTFRONT_SHARED_DATA}")
  endif ()
  pointfront_discover_tests(${name} TEST_PREFIX "${POINTFRONT_TEST_PREFIX}${test_PREFIX}."
    DISCOVERY_TIMEOUT 60 ${test_DISCOVER})
endfunction ()

# pointfront_add_module_test(<executable> MODULES <module>... [SUITES <suite>...]
#   [READS_DATA <suite>.<test>...] [MEASURES <suite>.<test>...] [SAME_CODE <suite>.<test>...])
# One executable of all Cxx/*.cxx of the calling folder. With SUITES its tests draw: each is one
# test on an X server; without, each test is found by itself.
# SAME_CODE: those of code that knows nothing of the VTK beside it. Where POINTFRONT_TEST_KERNEL is
# off, another preset runs them, and those of MEASURES.
function (pointfront_add_module_test name)
  cmake_parse_arguments(PARSE_ARGV 1 test "" "" "MODULES;SUITES;SAME_CODE;READS_DATA;MEASURES")
  find_package(GTest REQUIRED)
  file(GLOB sources CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/Cxx/*.cxx")
  add_executable(${name} ${sources})
  pointfront_test_program(${name})
  target_include_directories(${name} PRIVATE "${CMAKE_CURRENT_SOURCE_DIR}/Cxx"
    "${CMAKE_SOURCE_DIR}/vtkmodule/Core/Testing" "${CMAKE_SOURCE_DIR}/Testing/Support")
  target_link_libraries(${name} PRIVATE ${test_MODULES} pointfrontWarnings GTest::gtest_main)
  vtk_module_autoinit(TARGETS ${name} MODULES ${test_MODULES})
  if (test_SUITES)
    pointfront_name_leaks(${name})
    set(left_out "")
    if (NOT POINTFRONT_TEST_KERNEL)
      set(left_out ${test_SAME_CODE} ${test_MEASURES})
    elseif (POINTFRONT_SANITIZE)
      set(left_out ${test_MEASURES})
    endif ()
    if (left_out)
      list(JOIN left_out ":" left_out)
      string(PREPEND left_out "-")
    endif ()
    foreach (suite IN LISTS test_SUITES)
      if (NOT POINTFRONT_TEST_KERNEL AND "${suite}.*" IN_LIST test_SAME_CODE)
        continue ()
      endif ()
      pointfront_add_display_test(NAME "${name}.${suite}"
        COMMAND "$<TARGET_FILE:${name}>" "--gtest_filter=${suite}.*${left_out}")
    endforeach ()
  else ()
    pointfront_discover_tests(${name} TEST_PREFIX "${POINTFRONT_TEST_PREFIX}${name}."
      DISCOVERY_TIMEOUT 60 READS_DATA ${test_READS_DATA} MEASURES ${test_MEASURES})
  endif ()
endfunction ()
