# Windows, x86-64, on Debian and Ubuntu: g++-mingw-w64-x86-64-posix.
#   cmake --preset windows && cmake --build out/windows
# The run-time libraries are linked statically: one .exe, which needs only Windows' own libraries.
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
set(CMAKE_C_COMPILER x86_64-w64-mingw32-gcc-posix)
set(CMAKE_CXX_COMPILER x86_64-w64-mingw32-g++-posix)  # posix: std::thread and std::mutex
set(CMAKE_RC_COMPILER x86_64-w64-mingw32-windres)
set(CMAKE_EXE_LINKER_FLAGS_INIT -static)
# VKH_WINDOWS_LIBRARIES: what tools/packages/libraries has built.
set(CMAKE_FIND_ROOT_PATH /usr/x86_64-w64-mingw32 ${VKH_WINDOWS_LIBRARIES})
include(${CMAKE_CURRENT_LIST_DIR}/headers.cmake)
