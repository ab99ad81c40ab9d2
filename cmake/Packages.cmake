# cpack, in the build folder, writes .deb files for the distribution that it runs on:
#   vkhausdorff           the program
#   libvkhausdorff-dev    engine and host for C and C++, with files for find_package and pkg-config
#   python3-vkhausdorff   the Python package, where it is built
if(BUILD_SHARED_LIBS)
  return()  # a package of its own for the shared library is not made
endif()
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "The VkHausdorff authors <vkhausdorff@example.org>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)  # dpkg-dev, which build-essential brings
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS OFF)

# vkh_deb(GROUP NAME SECTION COMPONENT...): one package, with its copyright and changelog where
# Debian has them.
function(vkh_deb group name section)
  install(FILES ${PROJECT_SOURCE_DIR}/tools/packages/deb/copyright DESTINATION share/doc/${name}
          COMPONENT deb_${group} EXCLUDE_FROM_ALL)
  set(changelog ${PROJECT_BINARY_DIR}/deb/${name}/changelog)
  string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
  file(WRITE ${changelog} "${name} (${PROJECT_VERSION}) unstable; urgency=medium\n\n  * Release ${PROJECT_VERSION}.\n\n\
 -- ${CPACK_PACKAGE_CONTACT}  ${date}\n")
  file(ARCHIVE_CREATE OUTPUT ${changelog}.gz PATHS ${changelog} FORMAT raw COMPRESSION GZip COMPRESSION_LEVEL 9)
  install(FILES ${changelog}.gz DESTINATION share/doc/${name} COMPONENT deb_${group} EXCLUDE_FROM_ALL)
  set(components ${CPACK_COMPONENTS_ALL})
  foreach(component IN LISTS ARGN ITEMS deb_${group})
    list(APPEND components ${component})
    string(TOUPPER ${component} upper)
    set(CPACK_COMPONENT_${upper}_GROUP ${group} PARENT_SCOPE)
  endforeach()
  list(REMOVE_DUPLICATES components)
  set(CPACK_COMPONENTS_ALL ${components} PARENT_SCOPE)
  string(TOUPPER ${group} upper)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${name} PARENT_SCOPE)
  set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION ${section} PARENT_SCOPE)
endfunction()

set(CPACK_COMPONENTS_ALL)
set(loader libvulkan1)  # opened when a program runs, and not by --device native
set(headers_only "libvulkan-dev")
if(VKH_HOST)
  vkh_deb(vkh_program vkhausdorff science program)
  set(CPACK_DEBIAN_VKH_PROGRAM_PACKAGE_RECOMMENDS ${loader})
  set(CPACK_DEBIAN_VKH_PROGRAM_DESCRIPTION
      "The program: encloses the distance of two meshes in an interval that is\n proven, on a GPU or on the CPU, with Vulkan or without it.")
  vkh_deb(vkh_dev libvkhausdorff-dev libdevel engine host)
  set(headers_only "libvulkan-dev, libglm-dev")
  if(VKH_HAS_MESHOPTIMIZER)
    string(APPEND headers_only ", libmeshoptimizer-dev")
  endif()
  if(VKH_HAS_3MF)
    string(APPEND headers_only ", libzip-dev, libexpat1-dev")
  endif()
  if(VKH_HAS_CRYPTO)
    string(APPEND headers_only ", libssl-dev")
  endif()
  if(VKH_HAS_ZLIB)
    string(APPEND headers_only ", zlib1g-dev")
  endif()
else()
  vkh_deb(vkh_dev libvkhausdorff-dev libdevel engine)
endif()
set(CPACK_DEBIAN_VKH_DEV_PACKAGE_DEPENDS ${headers_only})
set(CPACK_DEBIAN_VKH_DEV_DESCRIPTION
    "The libraries: the engine for C, which records into a program's own Vulkan\n command buffers, and a blocking interface for C++20.")
if(TARGET vkh_python)
  vkh_deb(vkh_py python3-vkhausdorff python deb_python)
  math(EXPR next "${VKH_PYTHON_MINOR} + 1")  # the module is for the Python that it was built with
  set(CPACK_DEBIAN_VKH_PY_PACKAGE_DEPENDS
      "python3 (>= 3.${VKH_PYTHON_MINOR}), python3 (<< 3.${next}), python3-numpy")
  set(CPACK_DEBIAN_VKH_PY_PACKAGE_RECOMMENDS ${loader})
  set(CPACK_DEBIAN_VKH_PY_DESCRIPTION
      "The Python package: takes NumPy arrays and encloses the distance of two\n meshes in an interval that is proven.")
endif()
include(CPack)
