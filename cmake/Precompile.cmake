# Precompiled headers, which only GCC reads here. A room that is one unit reads each header once anyway, so that there only
# the tests have them.
option(VKH_PRECOMPILE "Precompile headers; OFF where each file is checked by itself" ON)
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/generated/empty.cpp CONTENT "")

# vkh_precompiled(NAME FLAGS HEADER...): the target NAME makes the header, by the FLAGS of its users: GCC refuses a
# header that was made with other flags.
function(vkh_precompiled name flags)
  if(NOT VKH_PRECOMPILE OR NOT CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    return()
  endif()
  add_library(${name} OBJECT EXCLUDE_FROM_ALL ${PROJECT_BINARY_DIR}/generated/empty.cpp)
  target_link_libraries(${name} PRIVATE ${flags})
  target_precompile_headers(${name} PRIVATE ${ARGN})
  target_compile_options(${name} PRIVATE -fpch-preprocess)  # for ccache
endfunction()

# vkh_precompile(TARGET NAME): TARGET reads the header that NAME makes, if there is one.
function(vkh_precompile target name)
  if(TARGET ${name})
    target_precompile_headers(${target} REUSE_FROM ${name})
    target_compile_options(${target} PRIVATE -fpch-preprocess)
  endif()
endfunction()
