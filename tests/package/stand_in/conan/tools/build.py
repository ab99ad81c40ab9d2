def stdcpp_library(conanfile):
    return "stdc++"  # as for GCC's
