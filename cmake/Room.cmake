# Words, tables and pages are not hot, and they are half of the host's compile time: -Og (docs/log/build.md).
add_library(vkh_cold INTERFACE)
target_compile_options(vkh_cold INTERFACE $<$<AND:$<CONFIG:Release>,$<COMPILE_LANG_AND_ID:CXX,GNU,Clang>>:-Og>)
if(VKH_SANITIZE)
  target_compile_options(vkh_cold INTERFACE -O0)
  set(VKH_COOL_ROOMS show survey solve)  # -Og takes 40 % less there; the readers' tests run for twice as long by it
endif()

if(NOT VKH_UNITY)  # what most files of the host include: with more in it, it costs more than it saves (docs/log/build.md)
  vkh_precompiled(vkh_room_headers "vkh_flags;vkh_hardening;glm::glm"
    <algorithm> <array> <cmath> <functional> <glm/geometric.hpp> <limits> <map> <memory> <optional> <span> <string> <vector>)
  if(TARGET vkh_room_headers)
    target_compile_features(vkh_room_headers PRIVATE cxx_std_20)
  endif()
endif()

# vkh_room(NAME [COLD] [WITHOUT FILE] [GENERATED FILE...] [DEFINITIONS NAME...] [LIBRARIES TARGET...]): the sources of the
# folder, and GENERATED ones, as the OBJECT library vkh_NAME. Files for one operating system end in
# _posix.cpp or _windows.cpp.
function(vkh_room name)
  cmake_parse_arguments(room COLD "" "WITHOUT;GENERATED;DEFINITIONS;LIBRARIES" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  if(WIN32)
    list(FILTER sources EXCLUDE REGEX "_posix\\.cpp$")
  else()
    list(FILTER sources EXCLUDE REGEX "_windows\\.cpp$")
  endif()
  foreach(file IN LISTS room_WITHOUT)
    list(REMOVE_ITEM sources ${CMAKE_CURRENT_SOURCE_DIR}/${file})
  endforeach()
  add_library(vkh_${name} OBJECT ${sources} ${room_GENERATED})
  target_compile_features(vkh_${name} PUBLIC cxx_std_20)
  target_link_libraries(vkh_${name} PRIVATE vkh_flags vkh_hardening glm::glm nlohmann_json::nlohmann_json Vulkan::Headers ${room_LIBRARIES})
  target_include_directories(vkh_${name} SYSTEM PRIVATE ${VKH_INCLUDE_FOLDERS})
  if(room_COLD)
    target_link_libraries(vkh_${name} PRIVATE vkh_cold)
  endif()
  if(name IN_LIST VKH_COOL_ROOMS)
    target_compile_options(vkh_${name} PRIVATE -Og)
  endif()
  target_compile_definitions(vkh_${name} PRIVATE VK_NO_PROTOTYPES $<$<BOOL:${WIN32}>:NOMINMAX> ${room_DEFINITIONS})
  vkh_unity(vkh_${name})
  vkh_precompile(vkh_${name} vkh_room_headers)
endfunction()
