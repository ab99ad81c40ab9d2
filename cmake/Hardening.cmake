# The hardening flags of the product (engine, host, program, Python module); every flag only if
# compiler and linker have it. Tests are not hardened: they test the arithmetic itself. As a
# subproject nothing is hardened: flags are the user's there.
option(VKH_HARDEN "FORTIFY_SOURCE, stack protector, read-only relocations, position-independent programs" ${PROJECT_IS_TOP_LEVEL})
add_library(vkh_hardening INTERFACE)
set(VKH_HARDENED)  # the checks of tests/package/hardening_test.py
if(NOT VKH_HARDEN OR VKH_SANITIZE)
  return()
endif()
include(CheckCXXSourceCompiles)
include(CheckPIESupported)

# vkh_links(VARIABLE COMPILE_FLAGS LINK_FLAGS): whether a program that copies into an array builds with them, and without a
# warning: older C libraries warn of level 3.
function(vkh_links variable compile link)
  set(CMAKE_REQUIRED_FLAGS "-O2 -Werror ${compile}")
  set(CMAKE_REQUIRED_LINK_OPTIONS ${link})
  set(CMAKE_REQUIRED_QUIET ON)
  check_cxx_source_compiles("#include <cstring>
#include <cstdio>
int main(int argc, char** argv) { char text[64]; std::strcpy(text, argv[argc - 1]); return std::puts(text); }" ${variable})
endfunction()

set(optimised $<NOT:$<CONFIG:Debug>>)  # FORTIFY_SOURCE needs the optimiser
foreach(level IN ITEMS 3 2)
  vkh_links(VKH_HAS_FORTIFY_${level} "-U_FORTIFY_SOURCE -D_FORTIFY_SOURCE=${level}" "")
  if(VKH_HAS_FORTIFY_${level})
    target_compile_options(vkh_hardening INTERFACE $<${optimised}:-U_FORTIFY_SOURCE> $<${optimised}:-D_FORTIFY_SOURCE=${level}>)
    list(APPEND VKH_HARDENED fortify)
    break()
  endif()
endforeach()
# MinGW has the canary in a library of its own, which users of our archives would have to name.
vkh_links(VKH_HAS_STACK_PROTECTOR "-fstack-protector-strong" "")
if(VKH_HAS_STACK_PROTECTOR AND NOT MINGW)
  target_compile_options(vkh_hardening INTERFACE -fstack-protector-strong)
  list(APPEND VKH_HARDENED stack)
endif()
vkh_links(VKH_HAS_RELRO "" "LINKER:-z,relro,-z,now")
if(VKH_HAS_RELRO)
  target_link_options(vkh_hardening INTERFACE LINKER:-z,relro,-z,now)
  list(APPEND VKH_HARDENED relro)
endif()
check_pie_supported(LANGUAGES CXX)  # from here on position-independent executables are linked as such
if(CMAKE_CXX_LINK_PIE_SUPPORTED)
  list(APPEND VKH_HARDENED pie)
endif()
message(STATUS "Hardening: ${VKH_HARDENED}")
