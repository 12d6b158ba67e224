/* SPDX-License-Identifier: MIT */
/* Numbers of a seed, among them those from the ends of their types. */
#ifndef FUZZ_DRAW_NUMBERS_H
#define FUZZ_DRAW_NUMBERS_H

#include <stdbool.h>
#include <stdint.h>

/* All numbers from now on are those of @seed. */
void numbers_start(uint64_t seed);
/* One float in @count is special; 0: none is. */
void numbers_wild(int count);

uint64_t random_word(void);
/* 0 to @limit - 1. */
int below(int limit);
bool one_in(int count);

float any_float(void);
void any_floats(float *out, int count);
/* 0 to @most, which is mostly kept. */
float float_to(float most);
int any_int(void);

#endif
