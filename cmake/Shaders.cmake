# vkh_add_shaders(target a.comp b.comp ...): a static library that holds the SPIR-V of every kernel
# and gives the generated headers, #include "kernels/a.h" and #include "kernels/all_kernels.h".
# A kernel is compiled again when a file that it includes changes.
option(VKH_FLATTEN_SHADERS "Embed kernels inlined, for drivers that do so slowly" ON)
if(NOT VKH_FLATTEN_SHADERS)
  message(STATUS "VKH_FLATTEN_SHADERS is OFF: CPU devices run the kernels of wide ones, which start later there")
endif()
# The headers are the same on every platform, and most of a build's time. The environment variable
# is for builds by other programs.
set(VKH_KERNELS "$ENV{VKH_KERNELS}" CACHE PATH "The embedded kernels of another build of these sources, its generated/kernels, instead of building them")
if(VKH_KERNELS)
  file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/generated)
  if(NOT IS_SYMLINK ${PROJECT_BINARY_DIR}/generated/kernels)  # left by a build that made its own
    file(REMOVE_RECURSE ${PROJECT_BINARY_DIR}/generated/kernels)
  endif()
  file(CREATE_LINK ${VKH_KERNELS} ${PROJECT_BINARY_DIR}/generated/kernels SYMBOLIC)
endif()
find_program(VKH_GLSLANG NAMES glslangValidator glslang)
find_program(VKH_SPIRV_VAL spirv-val)
find_program(VKH_SPIRV_OPT spirv-opt)
foreach(tool IN ITEMS GLSLANG SPIRV_VAL SPIRV_OPT)
  if(NOT VKH_${tool} AND NOT VKH_KERNELS)
    string(REPLACE "_" "-" program ${tool})
    string(TOLOWER ${program} program)
    message(FATAL_ERROR "${program} was not found, which the kernels are compiled with (Debian: glslang-tools spirv-tools). "
                        "Or give -DVKH_KERNELS=FOLDER, the generated/kernels of another build of these sources, "
                        "which are the same on every platform (docs/packages.md).")
  endif()
endforeach()
find_package(Python3 REQUIRED COMPONENTS Interpreter)
file(REAL_PATH ${CMAKE_CURRENT_LIST_DIR}/../tools/kernels VKH_EMBED_DIR)
set(VKH_EMBED ${VKH_EMBED_DIR}/embed_shaders.py)
set(VKH_RUN_EMBED ${Python3_EXECUTABLE} -B ${VKH_EMBED})  # -B: leave no __pycache__ in the sources
# Everything between a kernel's GLSL and its C++ is one process; these are its modules.
set(VKH_BUILD_KERNEL ${VKH_EMBED_DIR}/build_kernel.py)
set(VKH_KERNEL_PASSES by_address.py embed_shaders.py explicit_layout.py float_order.py kernel_templates.py shared_memory.py spirv_module.py)
list(TRANSFORM VKH_KERNEL_PASSES PREPEND ${VKH_EMBED_DIR}/)
set(VKH_RUN_BUILD_KERNEL ${Python3_EXECUTABLE} -B ${VKH_BUILD_KERNEL} --root ${PROJECT_SOURCE_DIR} --glslang ${VKH_GLSLANG}
                         --spirv-val ${VKH_SPIRV_VAL})
if(VKH_FLATTEN_SHADERS)
  list(APPEND VKH_RUN_BUILD_KERNEL --spirv-opt ${VKH_SPIRV_OPT})
endif()

function(vkh_add_shaders target)
  set(out ${PROJECT_BINARY_DIR}/generated/kernels)
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
  if(NOT VKH_KERNELS)
    execute_process(COMMAND ${VKH_RUN_EMBED} index ${out} ${names}
                    COMMAND_ERROR_IS_FATAL ANY)
  endif()

  add_library(${target} STATIC ${sources})
  target_include_directories(${target} PUBLIC ${PROJECT_BINARY_DIR}/generated ${PROJECT_SOURCE_DIR})
  target_link_libraries(${target} PUBLIC Vulkan::Headers)
  if(TARGET vkh_flags)
    target_link_libraries(${target} PRIVATE vkh_flags)
  endif()
  vkh_unity(${target})
endfunction()

function(vkh_add_kernel name shader out)
  if(VKH_KERNELS)
    return()
  endif()
  # The header is a by-product, since it keeps its time while its text is the same.
  add_custom_command(
    OUTPUT ${out}/${name}.cpp
    BYPRODUCTS ${out}/${name}.h ${out}/${name}.spv
    COMMAND ${VKH_RUN_BUILD_KERNEL} ${shader} ${out}
    DEPENDS ${shader} ${VKH_BUILD_KERNEL} ${VKH_KERNEL_PASSES}
    DEPFILE ${out}/${name}.d
    COMMENT "Compiling ${name}.comp"
    VERBATIM)
endfunction()
