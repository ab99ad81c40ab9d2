# cmake --install BUILD --prefix P: a package that may be moved afterwards. Every path in it is
# relative to itself; its dependencies (Vulkan headers, GLM) are found again at the user's.
# Components: engine; host (C++ library); program; python (host/python/CMakeLists.txt).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(VKH_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/VkHausdorff)
set(VKH_PC_DIR ${CMAKE_INSTALL_LIBDIR}/pkgconfig)

# vkh_install_pc(NAME COMPONENT): from the .pc file's own folder to the prefix, so that the package may be moved.
function(vkh_install_pc name component)
  file(RELATIVE_PATH VKH_PC_TO_PREFIX /prefix/${VKH_PC_DIR} /prefix)
  configure_file(cmake/${name}.pc.in ${PROJECT_BINARY_DIR}/${name}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/${name}.pc DESTINATION ${VKH_PC_DIR} COMPONENT ${component})
endfunction()

# The engine.
target_include_directories(vkh_engine INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
install(TARGETS vkh_engine EXPORT VkHausdorffEngine
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT engine
        LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT engine)
install(FILES ${VKH_ENGINE_HEADERS} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT engine)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT engine)
install(EXPORT VkHausdorffEngine NAMESPACE VkHausdorff:: DESTINATION ${VKH_PACKAGE_DIR} COMPONENT engine)
configure_package_config_file(cmake/VkHausdorffConfig.cmake.in ${PROJECT_BINARY_DIR}/VkHausdorffConfig.cmake
                              INSTALL_DESTINATION ${VKH_PACKAGE_DIR})
# Before 1.0 a minor version may break promises of the one before it.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/VkHausdorffConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/VkHausdorffConfig.cmake ${PROJECT_BINARY_DIR}/VkHausdorffConfigVersion.cmake
        DESTINATION ${VKH_PACKAGE_DIR} COMPONENT engine)
# A C program links the C++ run-time library that an archive of C++ objects needs, and that a shared
# library brings along.
set(VKH_PC_LIBS)
set(VKH_PC_DEFINES)
if(BUILD_SHARED_LIBS)
  set(VKH_PC_DEFINES " -DVKH_SHARED")
endif()
if(NOT BUILD_SHARED_LIBS)
  list(TRANSFORM VKH_CXX_RUNTIME PREPEND -l OUTPUT_VARIABLE VKH_PC_LIBS)
  list(APPEND VKH_PC_LIBS -pthread)
  list(JOIN VKH_PC_LIBS " " VKH_PC_LIBS)
endif()
vkh_install_pc(vkhausdorff engine)

if(NOT VKH_HOST)
  include(Packages)
  return()
endif()

set_target_properties(vkhausdorff PROPERTIES INSTALL_RPATH $<$<BOOL:${BUILD_SHARED_LIBS}>:$ORIGIN/../${CMAKE_INSTALL_LIBDIR}>)
install(TARGETS vkhausdorff RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
if(TARGET vkh_check)  # tools/quickstart builds the program alone: missing parts are named
  install(TARGETS vkh_check RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program OPTIONAL)
  install(CODE "if(NOT EXISTS \"$<TARGET_FILE:vkh_check>\")
  message(STATUS \"Not installed: vkh_check, which is not built yet (cmake --build ${CMAKE_BINARY_DIR})\")
endif()" COMPONENT program)
endif()
if(NOT WIN32)
  find_program(VKH_GZIP gzip)
  if(VKH_GZIP)  # as Debian wants it, without a time of its own
    execute_process(COMMAND ${VKH_GZIP} -9nc ${PROJECT_SOURCE_DIR}/docs/man/vkhausdorff.1 OUTPUT_FILE ${PROJECT_BINARY_DIR}/vkhausdorff.1.gz)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS docs/man/vkhausdorff.1)
    install(FILES ${PROJECT_BINARY_DIR}/vkhausdorff.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)
  else()
    install(FILES docs/man/vkhausdorff.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)
  endif()
  install(FILES tools/completion/vkhausdorff.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME vkhausdorff
          COMPONENT program)
  install(PROGRAMS tools/slurm/submit tools/slurm/job.sh DESTINATION ${CMAKE_INSTALL_DATADIR}/vkhausdorff/slurm COMPONENT program)
  install(FILES tools/completion/_vkhausdorff DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions COMPONENT program)
endif()
install(FILES cmake/VkHausdorffGate.cmake DESTINATION ${VKH_PACKAGE_DIR} COMPONENT program)
install(TARGETS vkh_host EXPORT VkHausdorffHost ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT host)
install(DIRECTORY host/include/vkhausdorff DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT host)
install(EXPORT VkHausdorffHost NAMESPACE VkHausdorff:: DESTINATION ${VKH_PACKAGE_DIR} COMPONENT host)
set(VKH_FORMAT_LIBS)
foreach(name IN LISTS VKH_FORMAT_LIBRARIES)
  string(APPEND VKH_FORMAT_LIBS " -l${name}")
endforeach()
vkh_install_pc(vkhausdorff-host host)
include(Packages)
