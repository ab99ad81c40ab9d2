# One program per folder of tests, and one per test file where the file needs a process, macros or flags of its own. doctest
# picks a file's cases by --source-file, so that ctest names each file either way, and moving a file is all that it takes.
set(VKH_TESTS_ALONE
  "/verification/math/"   # at the build's own optimization, and rebuilt one by one by tools/mutation.py
  "/faults/"              # layers and failing allocations, from before main on
  "/cgal_test"            # CGAL's headers take 22 s to compile
  "/frame_test"           # as math's
  "/diagonal_test"        # as math's
  "/read_cost_test"       # replaces operator new
  "/aligned_glm_test")    # macros of GLM
list(JOIN VKH_TESTS_ALONE "|" VKH_TESTS_ALONE)

# Their time is the compiler's (docs/log/build.md).
add_library(vkh_test_flags INTERFACE)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_BUILD_TYPE STREQUAL "Release")
  target_compile_options(vkh_test_flags INTERFACE -Og)
endif()
# -O1 takes twice as long, and the tests' computations are in vkh_test_support. UBSan's checks of each pointer take half
# of the rest; the product's sources have them, and a null pointer still ends a test.
if(VKH_SANITIZE)
  target_compile_options(vkh_test_flags INTERFACE -O0 -fno-sanitize=null,vptr,alignment,object-size)
endif()
# The flags of vkh_file_support are those of all tests; by vkh_test_support, programs of four rooms would wait for the whole host.
vkh_precompiled(vkh_test_headers "vkh_file_support;vkh_test_flags"
  <doctest/doctest.h> <glm/glm.hpp> <nlohmann/json.hpp> <algorithm> <array> <filesystem> <fstream> <functional> <map>
  <memory> <optional> <random> <span> <sstream> <string> <vector>)
if(TARGET vkh_test_headers)  # as programs are compiled
  set_target_properties(vkh_test_headers PROPERTIES POSITION_INDEPENDENT_CODE OFF)
  target_compile_options(vkh_test_headers PRIVATE ${CMAKE_CXX_COMPILE_OPTIONS_PIE})
endif()

# vkh_test_program(SOURCE OUT): sets OUT to the program that has the source's cases; makes it with its first source.
function(vkh_test_program source out)
  get_filename_component(name ${source} NAME_WE)
  if(source MATCHES "${VKH_TESTS_ALONE}")
    add_executable(${name} ${source})
    if(source MATCHES "/verification/math/" AND NOT name STREQUAL "lib_regroup_test")  # which needs the self-test of the program
      target_link_libraries(${name} PRIVATE vkh_math_support vkh_math_rooms)
    elseif(source MATCHES "/files/")
      target_link_libraries(${name} PRIVATE vkh_file_support vkh_file_rooms vkh_test_flags)
    else()
      target_link_libraries(${name} PRIVATE vkh_test_support)
    endif()
    set(${out} ${name} PARENT_SCOPE)
    return()
  endif()
  get_filename_component(room ${source} DIRECTORY)
  get_filename_component(room ${room} NAME)
  set(program ${room}_tests)
  set(${out} ${program} PARENT_SCOPE)
  if(TARGET ${program})
    target_sources(${program} PRIVATE ${source})
    return()
  endif()
  add_executable(${program} ${source})
  set(support vkh_test_support)
  if(room STREQUAL "files")
    set(support vkh_file_support vkh_file_rooms)
  endif()
  target_link_libraries(${program} PRIVATE ${support} vkh_test_flags)
  vkh_precompile(${program} vkh_test_headers)
endfunction()
