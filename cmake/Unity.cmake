# The sources of a room are compiled as one translation unit: most of their cost is the standard
# library, which is then read and instantiated once (docs/log/build.md). So a name in an anonymous
# namespace has one meaning in its room. The test `clang_all` reads each file by itself
# (tools/lint/alone.py), and clang_tidy reads the units.
option(VKH_UNITY "Compile each room as one translation unit" ON)

# vkh_unity(TARGET): groups the target's sources by unit. Call it in the folder that made the target.
function(vkh_unity target)
  if(NOT VKH_UNITY)
    return()
  endif()
  get_target_property(sources ${target} SOURCES)
  foreach(source IN LISTS sources)
    if(source MATCHES "^[^$]*\\.cpp$")
      get_filename_component(folder "${source}" DIRECTORY)
      get_filename_component(unit "${folder}" NAME)
      if(source MATCHES "/read/(gltf|threemf)[a-z0-9_]*\\.cpp$")  # two halves: one unit of them would be half of the host's
        set(unit scenes)
      endif()
      set_source_files_properties(${source} PROPERTIES UNITY_GROUP "${unit}")
    endif()
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  # GCC stops inlining where a large unit has grown by 40 %: bounding boxes took three times as long, frames twice
  # (docs/log/build.md).
  target_compile_options(${target} PRIVATE $<$<COMPILE_LANG_AND_ID:CXX,GNU>:--param=inline-unit-growth=400>)
  # GCC takes a file that a unit includes for a header, whose classes should hold no type of an anonymous namespace.
  target_compile_options(${target} PRIVATE $<$<COMPILE_LANG_AND_ID:CXX,GNU>:-Wno-subobject-linkage>)
endfunction()
