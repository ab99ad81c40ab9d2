# vkh_add_shaders(target a.comp b.comp ...): a static library that holds the SPIR-V of every kernel
# and gives the generated headers, #include "kernels/a.h" and #include "kernels/all_kernels.h".
# A kernel is compiled again when a file that it includes changes.
find_program(VKH_GLSLANG NAMES glslangValidator glslang REQUIRED)
find_program(VKH_SPIRV_VAL spirv-val REQUIRED)
find_program(VKH_SPIRV_OPT spirv-opt REQUIRED)
option(VKH_FLATTEN_SHADERS "Embed kernels inlined, for drivers that do so slowly" ON)
if(NOT VKH_FLATTEN_SHADERS)
  message(STATUS "VKH_FLATTEN_SHADERS is OFF: CPU devices run the kernels of wide ones, which start later there")
endif()
# They are the same on every platform, and most of a build's time. The environment's is for builds by other programs.
set(VKH_KERNELS "$ENV{VKH_KERNELS}" CACHE PATH "The embedded kernels of another build of these sources, its generated/kernels, instead of building them")
if(VKH_KERNELS)
  file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/generated)
  if(NOT IS_SYMLINK ${PROJECT_BINARY_DIR}/generated/kernels)  # of a build that made its own
    file(REMOVE_RECURSE ${PROJECT_BINARY_DIR}/generated/kernels)
  endif()
  file(CREATE_LINK ${VKH_KERNELS} ${PROJECT_BINARY_DIR}/generated/kernels SYMBOLIC)
endif()
find_package(Python3 REQUIRED COMPONENTS Interpreter)
file(REAL_PATH ${CMAKE_CURRENT_LIST_DIR}/../tools VKH_EMBED_DIR)
set(VKH_EMBED ${VKH_EMBED_DIR}/embed_shaders.py)
set(VKH_RUN_EMBED ${Python3_EXECUTABLE} -B ${VKH_EMBED})  # -B: leave no __pycache__ in the sources
# Every float operation is decorated before anything else looks at it; embedding asserts that all of them still are.
set(VKH_RUN_ORDER ${Python3_EXECUTABLE} -B ${VKH_EMBED_DIR}/float_order.py)
set(VKH_RUN_LAYOUT ${Python3_EXECUTABLE} -B ${VKH_EMBED_DIR}/explicit_layout.py)
set(VKH_PASSES ${VKH_EMBED_DIR}/float_order.py ${VKH_EMBED_DIR}/explicit_layout.py ${VKH_EMBED_DIR}/spirv_module.py)

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
endfunction()

# lavapipe inlines and brings to SSA form at every start of a program, and slower than it takes what is so already
# (docs/log/startup.md). Nothing here may touch floating point: no -O, no --simplify-instructions, which reassociate whatever is
# not `precise`. That is left to the drivers, whose rounding is specified.
set(VKH_FLATTEN
  --merge-return --inline-entry-points-exhaustive --eliminate-dead-functions
  --private-to-local --eliminate-local-single-block --eliminate-local-single-store --eliminate-dead-code-aggressive
  --scalar-replacement=0 --convert-local-access-chains --eliminate-local-single-block --eliminate-local-single-store
  --eliminate-dead-code-aggressive --ssa-rewrite --eliminate-dead-code-aggressive --ccp --eliminate-dead-branches
  --redundancy-elimination --eliminate-dead-branches --vector-dce --eliminate-dead-inserts
  --eliminate-dead-code-aggressive --merge-blocks --compact-ids)
# It also keeps what a wide device would do until it has been through most of that, and unrolls loops at a third of its
# time for nothing that runs faster. So every kernel is built a second time, for a device that is not wide, and its loops
# are marked to be left as they are (embed_shaders.py).
set(VKH_PRUNE --ccp --eliminate-dead-branches --eliminate-dead-functions)

# No -g0: reflection reads the debug names, of what the compiler wrote, for the optimiser drops buffers that are not used.
function(vkh_add_kernel name shader out)
  if(VKH_KERNELS)
    return()
  endif()
  set(spv ${out}/${name}.spv)
  set(flat)
  set(flatten)
  if(VKH_FLATTEN_SHADERS)
    set(flat ${out}/${name}.flat.spv ${out}/${name}.cpu.spv)
    set(optimise COMMAND ${VKH_SPIRV_OPT} --target-env=vulkan1.2 --scalar-block-layout)
    set(flatten ${optimise} ${VKH_FLATTEN} -o ${out}/${name}.flat.spv ${spv}
                COMMAND ${VKH_RUN_EMBED} narrow ${spv} ${out}/${name}.narrow.spv
                ${optimise} ${VKH_PRUNE} ${VKH_FLATTEN} -o ${out}/${name}.cpu.spv ${out}/${name}.narrow.spv)
    foreach(file IN LISTS flat)
      list(APPEND flatten COMMAND ${VKH_SPIRV_VAL} --target-env vulkan1.2 --scalar-block-layout ${file})
    endforeach()
    list(APPEND flatten BYPRODUCTS ${flat} ${out}/${name}.narrow.spv)
  endif()
  add_custom_command(
    OUTPUT ${spv}
    COMMAND ${VKH_GLSLANG} --quiet --target-env vulkan1.2 -I${PROJECT_SOURCE_DIR} --depfile ${spv}.d
            -o ${spv} ${shader}
    COMMAND ${VKH_RUN_ORDER} ${spv}
    COMMAND ${VKH_RUN_LAYOUT} ${spv}
    COMMAND ${VKH_SPIRV_VAL} --target-env vulkan1.2 --scalar-block-layout ${spv}
    ${flatten}
    DEPENDS ${shader} ${VKH_PASSES} ${VKH_EMBED}
    DEPFILE ${spv}.d
    COMMENT "Compiling ${name}.comp"
    VERBATIM)
  # The header is a by-product, since it keeps its time while its text is the same.
  add_custom_command(
    OUTPUT ${out}/${name}.cpp
    BYPRODUCTS ${out}/${name}.h
    COMMAND ${VKH_RUN_EMBED} kernel ${spv} ${out} ${flat}
    DEPENDS ${spv} ${VKH_EMBED} ${VKH_PASSES} ${VKH_EMBED_DIR}/kernel_templates.py ${VKH_EMBED_DIR}/shared_memory.py
    COMMENT "Embedding ${name}"
    VERBATIM)
endfunction()
