# vkh_add_shaders(target a.comp b.comp ...): a static library that holds the SPIR-V of every kernel
# and gives the generated headers, #include "kernels/a.h" and #include "kernels/all_kernels.h".
# A kernel is compiled again when a file that it includes changes.
find_program(VKH_GLSLANG glslangValidator REQUIRED)
find_program(VKH_SPIRV_VAL spirv-val REQUIRED)
find_package(Python3 REQUIRED COMPONENTS Interpreter)
file(REAL_PATH ${CMAKE_CURRENT_LIST_DIR}/../tools VKH_EMBED_DIR)
set(VKH_EMBED ${VKH_EMBED_DIR}/embed_shaders.py)
set(VKH_RUN_EMBED ${Python3_EXECUTABLE} -B ${VKH_EMBED})  # -B: leave no __pycache__ in the sources

function(vkh_add_shaders target)
  set(out ${CMAKE_BINARY_DIR}/generated/kernels)
  file(MAKE_DIRECTORY ${out})
  set(sources ${out}/all_kernels.cpp)
  set(names)
  foreach(shader IN LISTS ARGN)
    get_filename_component(shader ${shader} ABSOLUTE)
    get_filename_component(name ${shader} NAME_WE)
    vkh_add_kernel(${name} ${shader} ${out})
    list(APPEND names ${name})
    list(APPEND sources ${out}/${name}.cpp)
  endforeach()

  # The list of kernels changes only when CMake runs, so it is written now.
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${VKH_EMBED})
  execute_process(COMMAND ${VKH_RUN_EMBED} index ${out} ${names}
                  COMMAND_ERROR_IS_FATAL ANY)

  add_library(${target} STATIC ${sources})
  target_include_directories(${target} PUBLIC ${CMAKE_BINARY_DIR}/generated ${PROJECT_SOURCE_DIR})
  target_link_libraries(${target} PUBLIC Vulkan::Headers)
  if(TARGET vkh_flags)
    target_link_libraries(${target} PRIVATE vkh_flags)
  endif()
endfunction()

# No -g0: reflection reads the debug names. No spirv-opt: the drivers (NVIDIA's, lavapipe's LLVM)
# optimise, and what the validation layer and a profiler show stays what was written.
function(vkh_add_kernel name shader out)
  set(spv ${out}/${name}.spv)
  add_custom_command(
    OUTPUT ${spv}
    COMMAND ${VKH_GLSLANG} --quiet --target-env vulkan1.2 -I${PROJECT_SOURCE_DIR} --depfile ${spv}.d
            -o ${spv} ${shader}
    COMMAND ${VKH_SPIRV_VAL} --target-env vulkan1.2 --scalar-block-layout ${spv}
    DEPENDS ${shader}
    DEPFILE ${spv}.d
    COMMENT "Compiling ${name}.comp"
    VERBATIM)
  # The header is a by-product, since it keeps its time while its text is the same.
  add_custom_command(
    OUTPUT ${out}/${name}.cpp
    BYPRODUCTS ${out}/${name}.h
    COMMAND ${VKH_RUN_EMBED} kernel ${spv} ${out}
    DEPENDS ${spv} ${VKH_EMBED} ${VKH_EMBED_DIR}/spirv_module.py
    COMMENT "Embedding ${name}"
    VERBATIM)
endfunction()
