# Each compilation by ccache, where it is here. Its variables: what precompiled headers need, and no preprocessing for a miss.
option(VKH_CCACHE "Compile by ccache, if it is installed" OFF)
find_program(VKH_CCACHE_PROGRAM ccache)
find_program(VKH_ENV_PROGRAM env)
if(NOT VKH_CCACHE OR NOT VKH_CCACHE_PROGRAM OR NOT VKH_ENV_PROGRAM OR CMAKE_CXX_COMPILER_LAUNCHER)
  return()
endif()
set(CMAKE_CXX_COMPILER_LAUNCHER ${VKH_ENV_PROGRAM} CCACHE_DEPEND=1
    CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime ${VKH_CCACHE_PROGRAM})
set(CMAKE_C_COMPILER_LAUNCHER ${CMAKE_CXX_COMPILER_LAUNCHER})
