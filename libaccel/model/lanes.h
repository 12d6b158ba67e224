/* SPDX-License-Identifier: MIT */
/* How the hot loops are written and compiled: MODEL_LANES pixels or rows side by side. */
#ifndef ACCEL_MODEL_LANES_H
#define ACCEL_MODEL_LANES_H

#include <limits.h>

#include "model.h"

/*
 * Before a function whose loops are worth a second copy for AVX2; the copy is
 * chosen when the program is loaded, through an ifunc. Only glibc has ifuncs,
 * a sanitizer's run-time is not ready then, and clang 14 gives the function a
 * name that other files do not find.
 */
#if defined(__x86_64__) && defined(__GLIBC__) && defined(__GNUC__) && !defined(__clang__) && \
	!defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define MODEL_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define MODEL_CLONES
#endif

/* Part of a hot loop: becomes part of either copy. */
#define MODEL_INLINE static inline __attribute__((always_inline))

/* Whole lanes, so that a loop needs no second one for what is left over. */
MODEL_INLINE int model_lanes(int count)
{
	return (count + MODEL_LANES - 1) & ~(MODEL_LANES - 1);
}

MODEL_INLINE uint32_t model_clamp(int32_t value, int32_t most)
{
	value = value < 0 ? 0 : value;
	return (uint32_t)(value > most ? most : value);
}

#endif
