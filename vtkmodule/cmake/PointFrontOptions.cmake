# Options that a build chooses, and settings that hold for every target.

set(POINTFRONT_HOST "VTK" CACHE STRING
  "What the modules are built into: NONE (kernel and tool only), VTK or ParaView")
set_property(CACHE POINTFRONT_HOST PROPERTY STRINGS NONE VTK ParaView)
if (NOT POINTFRONT_HOST MATCHES "^(NONE|VTK|ParaView)$")
  message(FATAL_ERROR "POINTFRONT_HOST is '${POINTFRONT_HOST}': use NONE, VTK or ParaView")
endif ()
option(POINTFRONT_BUILD_TESTING "Build the tests" ON)
option(POINTFRONT_BUILD_BENCHMARKS "Build the benchmarks" OFF)
option(POINTFRONT_BUILD_FUZZERS "Build the fuzz targets (clang)" OFF)
option(POINTFRONT_WRAP_PYTHON "Wrap the VTK modules for Python" ON)
option(POINTFRONT_WHEEL "Lay everything out as one Python package, as pip installs it" OFF)
# Families of passes that a build may leave out. The tool then refuses what needs them, and its
# --version names what it was built without.
option(POINTFRONT_NORMALS "Normals and radii of splats, through FLANN and Eigen" ON)
option(POINTFRONT_PROJECTION "Coordinate reference systems, through PROJ" ON)
option(POINTFRONT_IMAGE_COLOR "Colours and values from images, through OpenImageIO" ON)
option(POINTFRONT_REMOTE "Clouds behind addresses (http, https, s3), through libcurl" ON)
set(pointfront_pcl_by_default ON)
if (POINTFRONT_HOST STREQUAL "NONE" OR POINTFRONT_WHEEL) # Debian's PCL brings VTK along
  set(pointfront_pcl_by_default OFF)
endif ()
option(POINTFRONT_PCL "Normals as the Point Cloud Library estimates them, too; tests compare"
  ${pointfront_pcl_by_default})
if (POINTFRONT_PCL AND NOT POINTFRONT_NORMALS)
  message(FATAL_ERROR "POINTFRONT_PCL is a way to normals: it needs POINTFRONT_NORMALS")
endif ()
option(POINTFRONT_WARNINGS_AS_ERRORS "Stop at a warning" OFF)
option(POINTFRONT_COMPILE_BY_FOLDER "Compile the sources of a folder as one" OFF)
option(POINTFRONT_PRECOMPILE "Compile the headers of CLI11 and JSON once" OFF)
option(POINTFRONT_COMPILE_TESTS_BY_FOLDER "Likewise those of a folder of tests" ON)
set(POINTFRONT_SANITIZE "" CACHE STRING
  "Sanitizers, as for -fsanitize=: address,undefined or thread")

if (NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif ()
set(CMAKE_CXX_STANDARD 17)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_CXX_VISIBILITY_PRESET default)
option(BUILD_SHARED_LIBS "Build shared libraries" ON)

if (POINTFRONT_WHEEL) # libraries, tool and extension modules side by side; a wheel has no links
  set(CMAKE_INSTALL_LIBDIR "pointfront")
  set(CMAKE_INSTALL_BINDIR "pointfront")
  set(CMAKE_PLATFORM_NO_VERSIONED_SONAME ON)
endif ()
set(CMAKE_INSTALL_DOCDIR "share/doc/pointfront" CACHE PATH "Where licence and changes go")
include(GNUInstallDirs)
set(pointfront_python_folder "${CMAKE_INSTALL_LIBDIR}/python3/dist-packages")
# Components of an installation, of which Debian's packages are made: Runtime (tool and kernel),
# Images, Modules (of VTK), Python, Development. A wheel is one: Runtime.
set(pointfront_modules_component Modules)
set(pointfront_python_component Python)
if (POINTFRONT_WHEEL)
  set(pointfront_python_folder ".")
  set(pointfront_modules_component Runtime)
  set(pointfront_python_component Runtime)
endif ()
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/${CMAKE_INSTALL_BINDIR}")
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/${CMAKE_INSTALL_LIBDIR}")
set(CMAKE_ARCHIVE_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/${CMAKE_INSTALL_LIBDIR}")
# Libraries beside each other; programs in bin; Python modules in
# lib/python3/dist-packages/pointfront.
set(CMAKE_INSTALL_RPATH "$ORIGIN;$ORIGIN/../${CMAKE_INSTALL_LIBDIR};$ORIGIN/../../..")

find_program(CCACHE_PROGRAM ccache)
if (CCACHE_PROGRAM AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_C_COMPILER_LAUNCHER "${CCACHE_PROGRAM}")
  set(CMAKE_CXX_COMPILER_LAUNCHER "${CCACHE_PROGRAM}")
endif ()

# The same bits on each machine: a product and a sum are rounded twice, whether or not the processor
# can round them once (FMA). GCC and Clang contract them unless they are told not to.
if (CMAKE_CXX_COMPILER_ID MATCHES "^(GNU|Clang|AppleClang)$")
  add_compile_options($<$<COMPILE_LANGUAGE:CXX>:-ffp-contract=off>)
endif ()

if (POINTFRONT_BUILD_FUZZERS)
  add_compile_options(-fsanitize=fuzzer-no-link) # coverage of the libraries leads the fuzzer
  add_compile_definitions(FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION) # checksums always match
endif ()
set(pointfront_sanitizing "")
if (POINTFRONT_SANITIZE)
  set(pointfront_sanitizing
    -fsanitize=${POINTFRONT_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  if (CMAKE_BUILD_TYPE STREQUAL "Release")
    list(APPEND pointfront_sanitizing -Og -g1 -UNDEBUG)
  endif ()
  if (POINTFRONT_SANITIZE MATCHES "undefined" AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # An illegal instruction where behaviour is undefined, instead of a report and its data: half
    # the code, and a tool that starts without two million relocations. ASAN_OPTIONS=handle_sigill=1
    # prints the place.
    list(APPEND pointfront_sanitizing -fsanitize-undefined-trap-on-error)
  endif ()
  add_compile_options(${pointfront_sanitizing})
  # The sanitizers call dlopen() in the program's place, and RUNPATH counts for the caller's own
  # calls only. RPATH counts for every call, so the libraries that the tool opens are found.
  add_link_options(-fsanitize=${POINTFRONT_SANITIZE} -Wl,--disable-new-dtags)
  if (POINTFRONT_SANITIZE MATCHES "address")
    # A library calls its own form of an inline function, not that of a program of tests, which is
    # compiled without checks (pointfront_test_program).
    add_link_options(-Wl,-Bsymbolic-functions)
  endif ()
endif ()

# For libraries whose inner loops call their own functions: nobody replaces these at run time, so
# the compiler may inline them (GCC does not when it builds a shared library; Clang does).
add_library(pointfrontInlining INTERFACE)
target_compile_options(pointfrontInlining INTERFACE
  $<$<CXX_COMPILER_ID:GNU>:-fno-semantic-interposition>)

# Our own targets only: headers of others are system headers.
add_library(pointfrontWarnings INTERFACE)
target_compile_options(pointfrontWarnings INTERFACE
  -Wall -Wextra -Wconversion -Wno-sign-conversion -Wnon-virtual-dtor -Woverloaded-virtual
  $<$<NOT:$<BOOL:$<TARGET_PROPERTY:UNITY_BUILD>>>:-Wshadow> # only makes sense of a source alone
  $<$<BOOL:${POINTFRONT_WARNINGS_AS_ERRORS}>:-Werror>)

# pointfront_compile_by_folder(<target> [ALWAYS | TESTS])
# With POINTFRONT_COMPILE_BY_FOLDER the sources of one folder are compiled as one: their headers and
# templates once. What they keep to themselves then needs names that are unique in the folder.
# ALWAYS: whatever that option says, for code that is mostly its headers' templates.
# TESTS: as POINTFRONT_COMPILE_TESTS_BY_FOLDER says.
function (pointfront_compile_by_folder target)
  if (NOT POINTFRONT_COMPILE_BY_FOLDER AND NOT "ALWAYS" IN_LIST ARGN
      AND NOT ("TESTS" IN_LIST ARGN AND POINTFRONT_COMPILE_TESTS_BY_FOLDER))
    return ()
  endif ()
  get_target_property(aliased ${target} ALIASED_TARGET) # VTK's name of a module's own target
  if (aliased)                                          # changed in 9.4
    set(target ${aliased})
  endif ()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  # A warning that only makes sense of a source alone.
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  get_target_property(sources ${target} SOURCES)
  list(FILTER sources INCLUDE REGEX "\\.cxx$")
  foreach (source IN LISTS sources)
    get_filename_component(folder "${source}" DIRECTORY)
    get_filename_component(folder "${folder}" NAME)
    set_source_files_properties("${source}" PROPERTIES UNITY_GROUP "${folder}_sources")
  endforeach ()
endfunction ()

# pointfront_add_library(<name> [SHARED] [INSTALL <folder>] [ROOMS <folder>...] [SOURCES <file>...]
#                        [LINK <library>...])
# A library of plain C++ over the kernel: the target pointfront<name>, called PointFront::<name>.
# Its sources are those of the current folder and of its ROOMS, unless SOURCES names them; its
# headers are installed below pointfront/<INSTALL>; it links to LINK in private.
function (pointfront_add_library name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "SHARED" "INSTALL" "ROOMS;SOURCES;LINK")
  set(target "pointfront${name}")
  set(folders "${CMAKE_CURRENT_SOURCE_DIR}")
  foreach (room IN LISTS arg_ROOMS)
    list(APPEND folders "${CMAKE_CURRENT_SOURCE_DIR}/${room}")
  endforeach ()
  if (NOT arg_SOURCES)
    list(TRANSFORM folders APPEND "/*.cxx" OUTPUT_VARIABLE patterns)
    file(GLOB arg_SOURCES CONFIGURE_DEPENDS ${patterns})
  endif ()
  set(kind "")
  if (arg_SHARED)
    set(kind SHARED)
  endif ()
  add_library(${target} ${kind} ${arg_SOURCES})
  pointfront_compile_by_folder(${target})
  add_library(PointFront::${name} ALIAS ${target})
  target_include_directories(${target} PUBLIC "$<BUILD_INTERFACE:${folders}>")
  if (arg_INSTALL)
    target_include_directories(${target} PUBLIC
      $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/pointfront/${arg_INSTALL}>)
  endif ()
  target_link_libraries(${target}
    PUBLIC PointFront::Core PRIVATE $<BUILD_INTERFACE:pointfrontWarnings> ${arg_LINK})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name}
    VERSION "${PROJECT_VERSION}" SOVERSION "${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}")
endfunction ()

# pointfront_add_tests(): the tests of the folder's library, where a build tests the kernel.
macro (pointfront_add_tests)
  if (POINTFRONT_BUILD_TESTING AND POINTFRONT_TEST_KERNEL)
    add_subdirectory(Testing)
  endif ()
endmacro ()
