# vkh_export(TARGET PATTERN): a shared library or module shows only the symbols of this pattern, and neither symbols that
# libstdc++ forces to be visible nor symbols of archives in it. Windows exports what is marked and nothing else.
function(vkh_export target pattern)
  if(APPLE)
    target_link_options(${target} PRIVATE "LINKER:-exported_symbol,_${pattern}")
  elseif(NOT WIN32)
    set(script ${PROJECT_BINARY_DIR}/generated/${target}.exports)
    file(CONFIGURE OUTPUT ${script} CONTENT "{ global: ${pattern}; local: *; };\n")
    target_link_options(${target} PRIVATE "LINKER:--version-script=${script}")
    set_property(TARGET ${target} APPEND PROPERTY LINK_DEPENDS ${script})
  endif()
endfunction()
