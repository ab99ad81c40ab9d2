# A shader of the user's own that reads a report.
find_program(GLSLANG NAMES glslangValidator glslang REQUIRED)
add_custom_target(shader ALL COMMAND ${GLSLANG} --quiet --target-env vulkan1.2
  "-I$<JOIN:$<TARGET_PROPERTY:VkHausdorff::engine,INTERFACE_INCLUDE_DIRECTORIES>,;-I>" -o ${CMAKE_BINARY_DIR}/close.spv
  ${CMAKE_CURRENT_LIST_DIR}/close.comp COMMAND_EXPAND_LISTS VERBATIM)
