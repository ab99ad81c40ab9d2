#@ theorem two_product is exact, however + - * are rounded, but for what is flushed
#@ quote two_float.h: VKH_FN float upper_half(float x) { return uintBitsToFloat(floatBitsToUint(x) & 0xfffff000u); }
#@ quote two_float.h: VKH_PRECISE float al = a - ah; VKH_PRECISE float bl = b - bh; VKH_PRECISE float p = a * b;
#@ quote two_float.h: VKH_PRECISE float e = ((ah * bh - p) + ah * bl + al * bh) + al * bl;
# By hand: powers of two do not matter, so a and b are integers in [2^23, 2^24), signs aside. upper_half cuts 12 bits off: AH
# is a multiple of 2^12, less than 2^12 under a. P is a * b rounded either way: next to it, among the multiples of 2^23
# under 2^47, of 2^24 above: an integer away, and nearer than the next.
# By Gappa: each result is a float (FLT 24), so that no rounding changes it. The last one is a b - P itself.
#@ case under 2^47
{ @FIX(A,0) /\ @FIX(B,0) /\ @FIX(AH,12) /\ @FIX(BH,12) /\ A in [8388608,16777215] /\ B in [8388608,16777215]
  /\ A - AH in [0,4095] /\ B - BH in [0,4095] /\ BH in [8388608,16773120]
  /\ @FIX(P,23) /\ P - A*B in [-8388607,8388607]
  -> @FLT(A-AH,24) /\ @FLT(B-BH,24) /\ @FLT(AH*BH,24) /\ @FLT(AH*(B-BH),24) /\ @FLT((A-AH)*BH,24)
  /\ @FLT((A-AH)*(B-BH),24) /\ @FLT(AH*BH-P,24) /\ @FLT((AH*BH-P)+AH*(B-BH),24)
  /\ @FLT(((AH*BH-P)+AH*(B-BH))+(A-AH)*BH,24) /\ @FLT(A*B-P,24) }
AH*BH-P -> -(P-A*B) - AH*(B-BH) - (A-AH)*BH - (A-AH)*(B-BH);
(AH*BH-P)+AH*(B-BH) -> -(P-A*B) - (A-AH)*BH - (A-AH)*(B-BH);
((AH*BH-P)+AH*(B-BH))+(A-AH)*BH -> -(P-A*B) - (A-AH)*(B-BH);
A*B-P -> -(P-A*B);
#@ case over 2^47
{ @FIX(A,0) /\ @FIX(B,0) /\ @FIX(AH,12) /\ @FIX(BH,12) /\ A in [8388608,16777215] /\ B in [8388608,16777215]
  /\ A - AH in [0,4095] /\ B - BH in [0,4095] /\ BH in [8388608,16773120]
  /\ @FIX(P,24) /\ P - A*B in [-16777215,16777215]
  -> @FLT(A-AH,24) /\ @FLT(B-BH,24) /\ @FLT(AH*BH,24) /\ @FLT(AH*(B-BH),24) /\ @FLT((A-AH)*BH,24)
  /\ @FLT((A-AH)*(B-BH),24) /\ @FLT(AH*BH-P,24) /\ @FLT((AH*BH-P)+AH*(B-BH),24)
  /\ @FLT(((AH*BH-P)+AH*(B-BH))+(A-AH)*BH,24) /\ @FLT(A*B-P,24) }
AH*BH-P -> -(P-A*B) - AH*(B-BH) - (A-AH)*BH - (A-AH)*(B-BH);
(AH*BH-P)+AH*(B-BH) -> -(P-A*B) - (A-AH)*BH - (A-AH)*(B-BH);
((AH*BH-P)+AH*(B-BH))+(A-AH)*BH -> -(P-A*B) - (A-AH)*(B-BH);
A*B-P -> -(P-A*B);
