# An overlay port, for this checkout: vcpkg install vkhausdorff --overlay-ports=tools/packages/vcpkg
# vcpkg, which has to fetch its tools and ports, has not been run; tests/package/engine_test.sh builds with these options.
get_filename_component(SOURCE_PATH "${CMAKE_CURRENT_LIST_DIR}/../../../.." ABSOLUTE)

vcpkg_find_acquire_program(PYTHON3)
vcpkg_cmake_configure(
    SOURCE_PATH "${SOURCE_PATH}"
    OPTIONS
        -DVKH_HOST=OFF
        "-DPython3_EXECUTABLE=${PYTHON3}"
        "-DCMAKE_PROGRAM_PATH=${CURRENT_HOST_INSTALLED_DIR}/tools/glslang;${CURRENT_HOST_INSTALLED_DIR}/tools/spirv-tools")
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(PACKAGE_NAME VkHausdorff CONFIG_PATH lib/cmake/VkHausdorff)
vcpkg_fixup_pkgconfig()
file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug/include" "${CURRENT_PACKAGES_DIR}/debug/share")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE")
