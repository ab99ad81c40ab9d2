# The host is the world: files, devices, memory, people.
if(BUILD_SHARED_LIBS AND VKH_TESTS)
  message(FATAL_ERROR "VKH_TESTS looks inside the engine and needs BUILD_SHARED_LIBS=OFF")
endif()
find_package(glm REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)
find_package(tinyobjloader REQUIRED)
file(GLOB VKH_HOST_SOURCES CONFIGURE_DEPENDS host/*/*.cpp)
list(FILTER VKH_HOST_SOURCES EXCLUDE REGEX "host/(cli/main\\.cpp|python/.*)$")
vkh_add_kernel(self_test ${PROJECT_SOURCE_DIR}/shaders/doctor/self_test.comp ${PROJECT_BINARY_DIR}/generated/kernels)
# An archive whatever BUILD_SHARED_LIBS says: C++ has no interface to keep between versions.
add_library(vkh_host STATIC ${VKH_HOST_SOURCES} ${PROJECT_BINARY_DIR}/generated/kernels/self_test.cpp)
if(BUILD_SHARED_LIBS)
  target_sources(vkh_host PRIVATE $<TARGET_OBJECTS:vkh_shaders>)  # a shared engine keeps its kernels to itself
endif()
target_link_libraries(vkh_host PRIVATE $<BUILD_INTERFACE:vkh_flags> $<BUILD_INTERFACE:vkh_hardening>
                      $<BUILD_INTERFACE:vkh_shaders> tinyobjloader::tinyobjloader
                      $<BUILD_INTERFACE:nlohmann_json::nlohmann_json> ${CMAKE_DL_LIBS} PUBLIC vkh_engine glm::glm)
target_compile_definitions(vkh_host PRIVATE VK_NO_PROTOTYPES)
target_compile_features(vkh_host PUBLIC cxx_std_20)
set_target_properties(vkh_host PROPERTIES OUTPUT_NAME vkhausdorff_host EXPORT_NAME host)
add_library(VkHausdorff::host ALIAS vkh_host)

add_executable(vkhausdorff host/cli/main.cpp)
target_link_libraries(vkhausdorff PRIVATE vkh_flags vkh_hardening vkh_host CLI11::CLI11 nlohmann_json::nlohmann_json)

add_subdirectory(tools)
if(VKH_EXAMPLES)
  add_subdirectory(examples)
endif()
if(BUILD_SHARED_LIBS AND VKH_PYTHON STREQUAL ON)
  message(FATAL_ERROR "VKH_PYTHON=ON keeps the engine inside the module and needs BUILD_SHARED_LIBS=OFF")
elseif(BUILD_SHARED_LIBS)
  message(STATUS "Python module: left out, for BUILD_SHARED_LIBS is on")
elseif(NOT VKH_PYTHON STREQUAL OFF)
  add_subdirectory(host/python)
endif()
