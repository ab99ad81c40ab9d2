# What others link: VkHausdorff::engine, by the same name in this tree and in a package, with <vkhausdorff.h>.
configure_file(engine/vkhausdorff.h ${PROJECT_BINARY_DIR}/generated/include/vkhausdorff.h COPYONLY)
target_include_directories(vkh_engine INTERFACE $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/generated/include>)

if(BUILD_SHARED_LIBS)
  add_library(VkHausdorff::engine ALIAS vkh_engine)
  return()
endif()

# An archive of C++ objects makes CMake link its users by the C++ compiler, which a project of C has not got. So users see
# a file and the C++ run-time library by name, where they link by the C compiler.
set(VKH_CXX_RUNTIME ${CMAKE_CXX_IMPLICIT_LINK_LIBRARIES})
list(REMOVE_ITEM VKH_CXX_RUNTIME ${CMAKE_C_IMPLICIT_LINK_LIBRARIES})
list(REMOVE_DUPLICATES VKH_CXX_RUNTIME)
target_link_libraries(vkh_engine INTERFACE "$<$<LINK_LANGUAGE:C>:${VKH_CXX_RUNTIME}>")
add_library(vkh_engine_file INTERFACE)
add_dependencies(vkh_engine_file vkh_engine)
target_include_directories(vkh_engine_file INTERFACE ${PROJECT_BINARY_DIR}/generated/include)
target_link_libraries(vkh_engine_file INTERFACE $<TARGET_FILE:vkh_engine> "$<$<LINK_LANGUAGE:C>:${VKH_CXX_RUNTIME}>"
                      Threads::Threads Vulkan::Headers)
add_library(VkHausdorff::engine ALIAS vkh_engine_file)
