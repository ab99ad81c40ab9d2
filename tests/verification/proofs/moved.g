#@ theorem raised(x) is over x + 2 kUlp abs(x) + kTiny / 2, lowered(x) under x - 2 kUlp abs(x) - kTiny / 2
#@ quote certified.h: VKH_FN float raised(float x) { return x + ({raised}f * kUlp * abs(x) + kTiny); }
#@ quote certified.h: VKH_FN float lowered(float x) { return x - ({lowered}f * kUlp * abs(x) + kTiny); }
#@ weakest raised: holds at 3.001, fails at 3
#@ weakest lowered: holds at 3.001, fails at 3
#@ weakest kUlp: holds at 2^-23, fails at 2^-24
# With A = abs(x) the result is more than x by Z + U (x + Z), with Z = (raised kUlp A + kTiny) (1 + T): the product is exact,
# a power of two. That is A times the first factor and kTiny times the second, at least. Downwards it is the same.
#@ case the factor of abs(x), up
{ T in @{both(ulp)} /\ U in @{both(ulp)} -> @{raised * kUlp} * (1 + T) * (1 + U) + U >= @{2 * ulp} /\
  @{raised * kUlp} * (1 + T) * (1 + U) - U >= @{2 * ulp} }
#@ case the factor of abs(x), down
{ T in @{both(ulp)} /\ U in @{both(ulp)} -> @{lowered * kUlp} * (1 + T) * (1 + U) + U >= @{2 * ulp} /\
  @{lowered * kUlp} * (1 + T) * (1 + U) - U >= @{2 * ulp} }
#@ case the factor of kTiny
{ T in @{both(ulp)} /\ U in @{both(ulp)} -> (1 + T) * (1 + U) >= 1b-1 }
