// Refuses to be compiled with arithmetic that has no NaN, or that sums in another order than is written. Has no code.
#pragma once

#if (defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__) || defined(__ASSOCIATIVE_MATH__) || defined(_M_FP_FAST)) && \
    !defined(FEELER_ALLOW_FAST_MATH)
#error \
    "feeler: with -ffast-math or /fp:fast a NaN from the device becomes a force; compile this file without it, or define FEELER_ALLOW_FAST_MATH to take the risk"
#endif
