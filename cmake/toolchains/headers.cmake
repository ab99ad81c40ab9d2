# A cross-build needs only headers of other projects, and the build machine has them. They are
# linked into a folder of their own in the build: /usr/include itself would bring the build
# machine's C library along.
set(VKH_HEADERS ${CMAKE_BINARY_DIR}/headers)
list(APPEND CMAKE_FIND_ROOT_PATH ${VKH_HEADERS})
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
get_property(is_trial GLOBAL PROPERTY IN_TRY_COMPILE)
if(is_trial OR EXISTS ${VKH_HEADERS}/complete)
  return()
endif()

# vkh_header_package(PACKAGE TARGET NAME...): find_package(PACKAGE) gives TARGET, with the headers NAME of /usr/include.
function(vkh_header_package package target)
  foreach(name IN LISTS ARGN)
    if(NOT EXISTS /usr/include/${name})
      message(WARNING "no /usr/include/${name}: the package ${package} will not be found (tools/setup --tests)")
      return()
    endif()
    file(CREATE_LINK /usr/include/${name} ${VKH_HEADERS}/include/${name} SYMBOLIC)
  endforeach()
  file(WRITE ${VKH_HEADERS}/lib/cmake/${package}/${package}Config.cmake
    "if(NOT TARGET ${target})\n"
    "  add_library(${target} INTERFACE IMPORTED)\n"
    "  set_target_properties(${target} PROPERTIES INTERFACE_INCLUDE_DIRECTORIES ${VKH_HEADERS}/include)\n"
    "endif()\n")
endfunction()

file(MAKE_DIRECTORY ${VKH_HEADERS}/include)
vkh_header_package(VulkanHeaders Vulkan::Headers vulkan vk_video)
vkh_header_package(glm glm::glm glm)
vkh_header_package(nlohmann_json nlohmann_json::nlohmann_json nlohmann)
vkh_header_package(CLI11 CLI11::CLI11 CLI)
vkh_header_package(stb stb::stb stb)
vkh_header_package(mustache mustache::mustache kainjow)
vkh_header_package(doctest doctest::doctest doctest boost)  # and the tests' arithmetic
file(TOUCH ${VKH_HEADERS}/complete)
