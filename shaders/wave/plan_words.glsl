// The words that the workgroup that plans shares: the first kPlanWords of `group_words`, which the
// kernel declares.
#ifndef VKH_SHADERS_WAVE_PLAN_WORDS_GLSL
#define VKH_SHADERS_WAVE_PLAN_WORDS_GLSL

#include "shaders/gpu_types.h"

// Words 0 to kSelectDigits - 1: the number of keys with each digit.
const uint kWordDecided = kSelectDigits;       // digits of the prefix,
const uint kWordPrefix = kWordDecided + 1u;    // which is a key, two words
const uint kWordBefore = kWordPrefix + 2u;     // keys under it
const uint kWordSelecting = kWordBefore + 1u;  // 0 or 1
const uint kWordRoom = kWordSelecting + 1u;    // candidates that can be refined
const uint kWordHeld = kWordRoom + 1u;         // candidates, if not all can be refined; else 0
const uint kWordReadFrom = kWordHeld + 1u;  // start of the half of the frontier that the wave reads
const uint kWordLargest = kWordReadFrom + 1u;  // control.select_largest
const uint kWordAdopted = kWordLargest + 1u;   // the new witness, seven words
const uint kPlanWords = kWordAdopted + 7u;

#endif
