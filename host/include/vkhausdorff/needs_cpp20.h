// Says in one line what a compiler of an older standard would say in hundreds.
#pragma once

#ifndef __cpp_concepts
#error \
    "VkHausdorff's C++ headers need C++20: compile with -std=c++20 (MSVC: /std:c++20); <vkhausdorff.h> needs C11 or C++11"
#endif
