# Chooses what `tools/test` runs by default. The goal for it is 20 minutes on two cores from a clone, builds included, and 50
# for `tools/test --full`, which .ci/run calls and which adds the tests labelled "full" (docs/log/build.md has what was
# measured). Those labelled "nightly" are for `ninja nightly`, and in the sanitizer tree for
# `ninja -C out/asan vkh_nightly && ctest --test-dir out/asan -L nightly`.

# vkh_label(LABEL TEST...): labels the tests that exist; the last call decides.
function(vkh_label label)
  foreach(test IN LISTS ARGN)
    if(TEST ${test})
      get_property(labels TEST ${test} PROPERTY LABELS)
      list(REMOVE_ITEM labels full nightly)
      set_property(TEST ${test} PROPERTY LABELS ${labels} ${label})
    endif()
  endforeach()
endfunction()

if(NOT VKH_SANITIZE)
  # Each takes over ten seconds, and checks the same as others do with more cases, on another device or driver, or in
  # processes that are ended. The faults, the proofs and the spoilt certificates guard what seldom changes.
  vkh_label(full fallbacks barriers api_address_test api_move_test presets_test
                 long_walk_test face_limits_test see effort schema doctor
                 memory_faults_test program_faults_test devices_faults_test
                 proofs mutation_quick attack certificate_polygons align points simplify_program batch folder_pairs exit_codes
                 python_life python_fork python_distances python_distances_life python_meshes python_metrics
                 metrics solver_oracle_test cgal_test pages)
  # Half a minute and more: the same kernels with more cases, by address, compiled for another card or system, on narrower
  # vectors or devices that a layer makes smaller; each fault of a driver at each of its calls; fits on a device, which are made
  # natively by default; lost devices and folders of batches, which others have once; the page in a browser; the examples of
  # clusters.
  vkh_label(nightly metrics_long placed_limits_long attack_long certificate_polygons_long proofs_in_coq proven_vkh_check proven_certificates proven_attack
                    proven_placing batch_killed clang_all align_test page_browser real_devices vulkan_faults_of_sets
                    batch_folders python_lost workspace_test api_limit_test two_drivers driver_lavapipe128_more platform_arm64 platform_libcxx
                    platform_arm64_more platform_nehalem platform_windows driver_swiftshader_more kernel_query_by_address kernel_bvh_by_address kernel_load_by_address
                    kernel_rank_by_address compile_amd regrouped embed_shaders driver_lavapipe128 vulkan_faults_test
                    slurm dask clusters points_many)
  # A program of its own whose one test is not a default one is built by vkh_full.
  foreach(source IN LISTS VKH_TEST_SOURCES)
    get_filename_component(name ${source} NAME_WE)
    get_property(labels TEST ${name} PROPERTY LABELS)
    if(VKH_PROGRAM_${name} STREQUAL name AND labels MATCHES "full|nightly")
      set_target_properties(${name} PROPERTIES EXCLUDE_FROM_ALL ON)
      add_dependencies(vkh_full ${name})
    endif()
  endforeach()
  add_dependencies(nightly vkh_full)
  return()
endif()

# The sanitizer tree begins with the code that accepts any file: the readers, their tests and their fuzzer, which need
# four rooms of the host. A start of the instrumented program takes two seconds and more, so that tests of many starts are
# full; and a compiled test takes twice the time of the release tree's.
set(VKH_QUICK_ROOMS files)
set(VKH_QUICK malformed_files leaks)
set(VKH_QUICK_PROGRAMS vkh_leak_probe vkh_leaky_driver)
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
vkh_label(full ${all})
# Half a minute and more each in the sanitizer tree: starts of the program by the dozen, whose code is
# also run by tests of one start, and searches of the same kernels with more cases. Of the long
# suites that run natively too, closest points stand for all.
vkh_label(nightly gate_test cli_test cli_parts_test cli_output_test face_limits_test shared_faces_test schema bodies
                  vkh_check certificates attack certificate_polygons batch batch_folders see effort recipes completion python_life
                  python_meshes python_lost python_environment python_fork python_certificate exit_codes placing many_pairs simplify_program
                  align metrics metrics_long folder_pairs points points_many vulkan_faults_test memory_faults_test devices_faults_test long_walk_test over_test together_test
                  align_test native_solver_test metrics_natively survey_natively wave_survey_natively simplify_natively cells_natively align_natively
                  point_distances_natively signed_natively answer_json_test
                  pages packed_glb native_program files_by_program pair_schema python_progress python_metrics python_align python_field python_simplify
                  fine_test placed_limits_test closest_test self_test_test cells_test)
# Arithmetic in exact numbers, and kernels beside their twins on the processor: the sanitizers see the tests alone.
vkh_label(nightly polygon_test decimal_test orientation_test printed_numbers_test)
# A program whose one test is nightly is built by vkh_nightly.
add_custom_target(vkh_nightly)
foreach(source IN LISTS VKH_TEST_SOURCES)
  get_filename_component(name ${source} NAME_WE)
  if(source MATCHES "/verification/math/|/kernel_[a-z_]*_test")
    vkh_label(nightly ${name})
  endif()
  get_property(labels TEST ${name} PROPERTY LABELS)
  if(VKH_PROGRAM_${name} STREQUAL name AND labels MATCHES "nightly")
    set_target_properties(${name} PROPERTIES EXCLUDE_FROM_ALL ON)
    add_dependencies(vkh_nightly ${name})
  endif()
endforeach()
# The programs of these tests, and the readers' fuzzer: all that tools/test builds of this tree without --full.
list(REMOVE_DUPLICATES VKH_QUICK_PROGRAMS)
add_custom_target(vkh_quick DEPENDS ${VKH_QUICK_PROGRAMS} read_fuzz)
