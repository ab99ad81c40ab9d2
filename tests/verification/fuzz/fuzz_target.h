// The functions that libFuzzer calls, or tests/verification/fuzz/driver.cpp if a compiler has no
// libFuzzer.
#pragma once

#include <cstddef>
#include <cstdint>

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv);
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);
extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t max_size,
                                          unsigned seed);
/// The function that both provide: one change of its own, by words of a dictionary among others.
extern "C" size_t LLVMFuzzerMutate(uint8_t* data, size_t size, size_t max_size);
