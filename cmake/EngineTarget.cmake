# The target that others link: VkHausdorff::engine, by the same name in this tree and in a package,
# with <vkhausdorff.h> and vkhausdorff_report.glsl.
add_library(VkHausdorff::engine ALIAS vkh_engine)
# These are the public headers, for C and for shaders; glslang finds the latter by -I of the same folder.
set(VKH_ENGINE_HEADERS engine/vkhausdorff.h engine/vkhausdorff_experimental.h engine/vkhausdorff_report.glsl)
foreach(header IN LISTS VKH_ENGINE_HEADERS)
  get_filename_component(name ${header} NAME)
  configure_file(${header} ${PROJECT_BINARY_DIR}/generated/include/${name} COPYONLY)
endforeach()
target_include_directories(vkh_engine INTERFACE $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/generated/include>)

# An archive of C++ objects needs the C++ run-time library. A project of C has no C++ compiler to link by, and gets it by name.
set(VKH_CXX_RUNTIME)
if(NOT BUILD_SHARED_LIBS)
  set(VKH_CXX_RUNTIME ${CMAKE_CXX_IMPLICIT_LINK_LIBRARIES})
  list(REMOVE_ITEM VKH_CXX_RUNTIME ${CMAKE_C_IMPLICIT_LINK_LIBRARIES})
  list(REMOVE_DUPLICATES VKH_CXX_RUNTIME)
  target_link_libraries(vkh_engine INTERFACE "$<$<LINK_LANGUAGE:C>:${VKH_CXX_RUNTIME}>")
endif()
