# The host is the world: files, devices, memory, people.
if(BUILD_SHARED_LIBS AND VKH_TESTS)
  message(FATAL_ERROR "VKH_TESTS looks inside the engine and needs BUILD_SHARED_LIBS=OFF")
endif()
find_package(glm REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)
# What only some files need, by the names that linkers know, so that the installed archive names no path; files that need
# what is missing are refused by name.
find_file(VKH_MESHOPTIMIZER_HEADER meshoptimizer.h)
find_library(VKH_MESHOPTIMIZER_LIBRARY meshoptimizer)
find_file(VKH_ZIP_HEADER zip.h)
find_library(VKH_ZIP_LIBRARY zip)
find_file(VKH_EXPAT_HEADER expat.h)
find_library(VKH_EXPAT_LIBRARY expat)
set(VKH_FORMAT_LIBRARIES)
if(VKH_MESHOPTIMIZER_HEADER AND VKH_MESHOPTIMIZER_LIBRARY)
  set(VKH_HAS_MESHOPTIMIZER ON)
  list(APPEND VKH_FORMAT_LIBRARIES meshoptimizer)
else()
  message(STATUS "Not read here: glTF with EXT_meshopt_compression, which needs libmeshoptimizer-dev")
endif()
if(VKH_ZIP_HEADER AND VKH_ZIP_LIBRARY AND VKH_EXPAT_HEADER AND VKH_EXPAT_LIBRARY)
  set(VKH_HAS_3MF ON)
  list(APPEND VKH_FORMAT_LIBRARIES zip expat)
else()
  message(STATUS "Not read here: 3MF, which needs libzip-dev and libexpat1-dev")
endif()
# Hashes of files; Windows has them itself.
find_file(VKH_CRYPTO_HEADER openssl/evp.h)
find_library(VKH_CRYPTO_LIBRARY crypto)
if(WIN32)
  list(APPEND VKH_FORMAT_LIBRARIES bcrypt)
elseif(VKH_CRYPTO_HEADER AND VKH_CRYPTO_LIBRARY)
  set(VKH_HAS_CRYPTO ON)
  list(APPEND VKH_FORMAT_LIBRARIES crypto)
else()
  message(STATUS "Not here: the SHA-256 of files, which needs libssl-dev")
endif()
# What vkh_check counts with.
find_file(VKH_GMP_HEADER gmp.h)
find_library(VKH_GMP_LIBRARY gmp)
# Pictures: letters and PNG. Of headers alone, so that a cross-build has them, too (cmake/toolchains/headers.cmake).
find_file(VKH_STB_HEADER stb/stb_truetype.h)
if(VKH_STB_HEADER)
  set(VKH_HAS_STB ON)
else()
  message(STATUS "Not here: pictures, which need libstb-dev")
endif()
# Pages are smaller with it; libzip brings it along.
find_file(VKH_ZLIB_HEADER zlib.h)
find_library(VKH_ZLIB_LIBRARY z)
if(VKH_ZLIB_HEADER AND VKH_ZLIB_LIBRARY)
  set(VKH_HAS_ZLIB ON)
  list(APPEND VKH_FORMAT_LIBRARIES z)
else()
  message(STATUS "Not here: deflated meshes in reports, which need zlib1g-dev")
endif()
file(GLOB VKH_HOST_SOURCES CONFIGURE_DEPENDS host/*/*.cpp)
list(FILTER VKH_HOST_SOURCES EXCLUDE REGEX "host/(cli|program|python)/.*$")
if(NOT VKH_HAS_3MF)
  list(FILTER VKH_HOST_SOURCES EXCLUDE REGEX "host/threemf/(model|package|volumes|xml)\\.cpp$")
endif()
if(WIN32)  # what operating systems do differently stands in host/system
  list(FILTER VKH_HOST_SOURCES EXCLUDE REGEX "_posix\\.cpp$")
else()
  list(FILTER VKH_HOST_SOURCES EXCLUDE REGEX "_windows\\.cpp$")
endif()
# What reads meshes is of no engine, so that vkh_check takes it in without one.
set(VKH_READER_SOURCES ${VKH_HOST_SOURCES})
list(FILTER VKH_READER_SOURCES INCLUDE REGEX "host/(base|system|mesh|source|read|scene|gltf|threemf)/[^/]*$")
list(REMOVE_ITEM VKH_HOST_SOURCES ${VKH_READER_SOURCES})
add_library(vkh_reader OBJECT ${VKH_READER_SOURCES})
target_link_libraries(vkh_reader PRIVATE vkh_flags vkh_hardening glm::glm nlohmann_json::nlohmann_json)
target_compile_features(vkh_reader PUBLIC cxx_std_20)
vkh_unity(vkh_reader)
vkh_add_kernel(self_test ${PROJECT_SOURCE_DIR}/shaders/doctor/self_test.comp ${PROJECT_BINARY_DIR}/generated/kernels)
# What pictures are drawn with: generated/draw/NAME.h with an array each, k_mesh_vert and k_mesh_frag, and kFont.
if(NOT VKH_GLSLANG)
  message(FATAL_ERROR "glslang was not found, which the shaders of pictures are compiled with (Debian: glslang-tools); VKH_HOST=OFF needs none")
endif()
set(VKH_DRAW_OUT ${PROJECT_BINARY_DIR}/generated/draw)
file(MAKE_DIRECTORY ${VKH_DRAW_OUT})
foreach(stage IN ITEMS vert frag)
  add_custom_command(
    OUTPUT ${VKH_DRAW_OUT}/mesh_${stage}.h
    COMMAND ${VKH_GLSLANG} --quiet --target-env vulkan1.2 --vn k_mesh_${stage} -o ${VKH_DRAW_OUT}/mesh_${stage}.h
            ${PROJECT_SOURCE_DIR}/host/draw/mesh.${stage}
    DEPENDS ${PROJECT_SOURCE_DIR}/host/draw/mesh.${stage}
    COMMENT "Compiling mesh.${stage}"
    VERBATIM)
endforeach()
add_custom_command(
  OUTPUT ${VKH_DRAW_OUT}/font.h
  COMMAND ${Python3_EXECUTABLE} -B ${PROJECT_SOURCE_DIR}/tools/draw/embed_font.py
          ${PROJECT_SOURCE_DIR}/host/draw/font/OpenSans-subset.ttf ${VKH_DRAW_OUT}/font.h
  DEPENDS ${PROJECT_SOURCE_DIR}/host/draw/font/OpenSans-subset.ttf ${PROJECT_SOURCE_DIR}/tools/draw/embed_font.py
  COMMENT "Embedding the font"
  VERBATIM)
# Nothing of what words, tables and pages are made by is hot, and it is half of the host's compile time: -Og (docs/log/build.md).
add_library(vkh_cold INTERFACE)
target_compile_options(vkh_cold INTERFACE $<$<AND:$<CONFIG:Release>,$<COMPILE_LANG_AND_ID:CXX,GNU,Clang>>:-Og>)
if(VKH_SANITIZE)
  target_compile_options(vkh_cold INTERFACE -O0)
endif()
set(VKH_COLD_SOURCES ${VKH_HOST_SOURCES})
list(FILTER VKH_COLD_SOURCES INCLUDE REGEX "host/(answer|parts|record|page|export|pictures|job|batch|many)/[^/]*$")
list(REMOVE_ITEM VKH_HOST_SOURCES ${VKH_COLD_SOURCES})
# An archive whatever BUILD_SHARED_LIBS says: C++ has no interface to keep between versions.
include(Page)
add_library(vkh_answers OBJECT ${VKH_COLD_SOURCES})
add_library(vkh_host STATIC ${VKH_HOST_SOURCES} $<TARGET_OBJECTS:vkh_reader> $<TARGET_OBJECTS:vkh_answers> ${VKH_PAGE_ASSETS} ${PROJECT_BINARY_DIR}/generated/kernels/self_test.cpp
            ${VKH_DRAW_OUT}/mesh_vert.h ${VKH_DRAW_OUT}/mesh_frag.h ${VKH_DRAW_OUT}/font.h)
if(BUILD_SHARED_LIBS)
  target_sources(vkh_host PRIVATE $<TARGET_OBJECTS:vkh_shaders>)  # a shared engine keeps its kernels to itself
endif()
target_link_libraries(vkh_host PRIVATE $<BUILD_INTERFACE:vkh_flags> $<BUILD_INTERFACE:vkh_hardening>
                      $<BUILD_INTERFACE:vkh_shaders> $<BUILD_INTERFACE:nlohmann_json::nlohmann_json> ${CMAKE_DL_LIBS} PUBLIC vkh_engine glm::glm)
target_link_libraries(vkh_host PRIVATE ${VKH_FORMAT_LIBRARIES})
target_link_libraries(vkh_answers PRIVATE vkh_flags vkh_hardening vkh_cold vkh_shaders nlohmann_json::nlohmann_json Vulkan::Headers
                      glm::glm)
foreach(target IN ITEMS vkh_reader vkh_answers vkh_host)
  target_compile_definitions(${target} PRIVATE $<$<BOOL:${VKH_HAS_MESHOPTIMIZER}>:VKH_HAS_MESHOPTIMIZER>
                             $<$<BOOL:${VKH_HAS_3MF}>:VKH_HAS_3MF> $<$<BOOL:${VKH_HAS_CRYPTO}>:VKH_HAS_CRYPTO>
                             $<$<BOOL:${VKH_HAS_STB}>:VKH_HAS_STB> $<$<BOOL:${VKH_HAS_ZLIB}>:VKH_HAS_ZLIB>
                             $<$<BOOL:${WIN32}>:NOMINMAX>)
endforeach()
foreach(target IN ITEMS vkh_answers vkh_host)
  target_compile_definitions(${target} PRIVATE VK_NO_PROTOTYPES)
  vkh_unity(${target})
endforeach()
target_compile_features(vkh_host PUBLIC cxx_std_20)
set_target_properties(vkh_host PROPERTIES OUTPUT_NAME vkhausdorff_host EXPORT_NAME host)
add_library(VkHausdorff::host ALIAS vkh_host)

file(GLOB VKH_PROGRAM_SOURCES CONFIGURE_DEPENDS host/cli/*.cpp host/program/*.cpp)
add_executable(vkhausdorff ${VKH_PROGRAM_SOURCES})
if(WIN32)
  target_sources(vkhausdorff PRIVATE host/program/windows.rc)
endif()
vkh_unity(vkhausdorff)
target_link_libraries(vkhausdorff PRIVATE vkh_flags vkh_hardening vkh_cold vkh_host CLI11::CLI11 nlohmann_json::nlohmann_json)

if(VKH_GMP_HEADER AND VKH_GMP_LIBRARY AND (VKH_HAS_CRYPTO OR WIN32))
  file(GLOB VKH_CHECK_SOURCES CONFIGURE_DEPENDS check/*.cpp)
  add_executable(vkh_check ${VKH_CHECK_SOURCES} $<TARGET_OBJECTS:vkh_reader>)
  target_link_libraries(vkh_check PRIVATE vkh_flags vkh_hardening glm::glm CLI11::CLI11 ${VKH_FORMAT_LIBRARIES} gmp ${CMAKE_DL_LIBS}
                        Threads::Threads)
else()
  message(STATUS "Not built here: vkh_check, which needs libgmp-dev and libssl-dev")
endif()

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
