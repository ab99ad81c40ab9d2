# Tools that make an edited file's tests run sooner, if they are installed: ccache, and a linker that takes a tenth of ld's
# time.
option(VKH_CCACHE "Compile by ccache, if it is installed" OFF)
option(VKH_FAST_LINK "Link by mold or lld, if one is installed" OFF)

# Precompiled headers need this of ccache. CCACHE_DEPEND: a miss costs no preprocessing of its own.
find_program(VKH_CCACHE_PROGRAM ccache)
find_program(VKH_ENV_PROGRAM env)
if(VKH_CCACHE AND VKH_CCACHE_PROGRAM AND VKH_ENV_PROGRAM AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${VKH_ENV_PROGRAM} CCACHE_DEPEND=1
      CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime ${VKH_CCACHE_PROGRAM})
  set(CMAKE_C_COMPILER_LAUNCHER ${CMAKE_CXX_COMPILER_LAUNCHER})
endif()

find_program(VKH_LINKER NAMES mold ld.lld)
if(VKH_FAST_LINK AND VKH_LINKER)
  get_filename_component(linker ${VKH_LINKER} NAME)
  string(REPLACE "ld.lld" "lld" linker ${linker})
  add_link_options(-fuse-ld=${linker})
endif()
