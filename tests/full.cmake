# Chooses what `tools/test` runs by default; the tests labelled "full" are for `tools/test --full`, which .ci/run calls. The
# goal for the default is 20 minutes on two cores from a clone, builds included (docs/log/build.md has what was measured).

# vkh_full(TEST...): labels those that there are.
function(vkh_full)
  foreach(test IN LISTS ARGN)
    if(TEST ${test})
      set_property(TEST ${test} PROPERTY LABELS full)
    endif()
  endforeach()
endfunction()

if(NOT VKH_SANITIZE)
  # Each takes a minute or more, and checks the same as others do with fewer cases, or on one device.
  vkh_full(compile_amd fallbacks barriers vulkan_faults_of_sets workspace_test batch_folders python_distances
           kernel_query_by_address kernel_bvh_by_address kernel_load_by_address)
  return()
endif()

# The sanitizer tree begins with the code that accepts any input: readers, scenes, lists, reports,
# the C API's misuse, the fuzzers. A start of the instrumented program takes two seconds and more,
# so that tests of many starts are full.
set(VKH_QUICK_ROOMS read scene host answer batch page)
set(VKH_QUICK api_input_test pair_schema malformed_files leaks)
set(VKH_QUICK_PROGRAMS vkhausdorff engine_tests vkh_leak_probe vkh_leaky_driver)
foreach(source IN LISTS VKH_TEST_SOURCES)
  get_filename_component(name ${source} NAME_WE)
  get_filename_component(room ${source} DIRECTORY)
  get_filename_component(room ${room} NAME)
  if(room IN_LIST VKH_QUICK_ROOMS)
    list(APPEND VKH_QUICK ${name})
    list(APPEND VKH_QUICK_PROGRAMS ${VKH_PROGRAM_${name}})
  endif()
endforeach()
get_property(all DIRECTORY PROPERTY TESTS)
list(REMOVE_ITEM all ${VKH_QUICK})
vkh_full(${all})
# The programs of these tests and of tests/fuzz: all that tools/test builds of this tree without --full.
list(REMOVE_DUPLICATES VKH_QUICK_PROGRAMS)
add_custom_target(vkh_quick DEPENDS ${VKH_QUICK_PROGRAMS} read_fuzz api_fuzz)
