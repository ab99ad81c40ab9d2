# cmake --install BUILD --prefix P: a package that may be moved afterwards. Every path in it is relative to itself; what it
# depends on (Vulkan headers, GLM, tinyobjloader) is found again where it is used.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# Headers of host/ that a user of vkh::Solver includes. Among themselves they say "host/mesh/mesh.h", in a package that is
# <vkhausdorff/mesh.h>; the engine's header is <vkhausdorff.h>.
set(VKH_HOST_HEADERS base/error gpu/device gpu/device_description gpu/vulkan_api mesh/mesh read/mesh_io run/solve_options
                     solve/report solve/solver)
set(VKH_INSTALLED_HEADERS ${CMAKE_CURRENT_BINARY_DIR}/generated/include/vkhausdorff)
foreach(header IN LISTS VKH_HOST_HEADERS)
  get_filename_component(name ${header} NAME)
  set(from ${PROJECT_SOURCE_DIR}/host/${header}.h)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${from})
  file(READ ${from} text)
  string(REGEX REPLACE "#include \"host/[a-z]+/" "#include \"vkhausdorff/" text "${text}")
  string(REPLACE "#include \"engine/vkhausdorff.h\"" "#include \"vkhausdorff.h\"" text "${text}")
  file(CONFIGURE OUTPUT ${VKH_INSTALLED_HEADERS}/${name}.h CONTENT "${text}" @ONLY)
endforeach()

target_include_directories(vkh_engine INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
install(TARGETS vkhausdorff RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(TARGETS vkh_engine vkh_host EXPORT VkHausdorffTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(FILES engine/vkhausdorff.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(DIRECTORY ${VKH_INSTALLED_HEADERS} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})

set(VKH_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/VkHausdorff)
install(EXPORT VkHausdorffTargets NAMESPACE VkHausdorff:: DESTINATION ${VKH_PACKAGE_DIR})
configure_package_config_file(cmake/VkHausdorffConfig.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/VkHausdorffConfig.cmake
                              INSTALL_DESTINATION ${VKH_PACKAGE_DIR})
# Before 1.0 a minor version may break what the one before it promised.
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/VkHausdorffConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/VkHausdorffConfig.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/VkHausdorffConfigVersion.cmake DESTINATION ${VKH_PACKAGE_DIR})

# From the .pc file's own folder to the prefix, so that the package may be moved.
set(VKH_PC_DIR ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
file(RELATIVE_PATH VKH_PC_TO_PREFIX /prefix/${VKH_PC_DIR} /prefix)
foreach(name IN ITEMS vkhausdorff vkhausdorff-host)
  configure_file(cmake/${name}.pc.in ${CMAKE_CURRENT_BINARY_DIR}/${name}.pc @ONLY)
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/${name}.pc DESTINATION ${VKH_PC_DIR})
endforeach()
