// The bounds of shaders/math, their own text with double for float, as vkh::native. Their
// derivations count roundings of kUlp and low parts of kUlp2, and hold with the constants of
// host/native/certified.h and two_double.h. What used the range or the bits of a float is not used
// here (docs/certificate.md, "In doubles"): bits, `scaled`, and surfaces of 48 bits, since every
// surface may be coarse.
#pragma once

#include "host/native/certified.h"
#include "host/native/marked.h"
#define float double
#include "shaders/math/bounds.h"
#include "shaders/math/dyadic.h"
#include "shaders/math/lower.h"
#undef float
