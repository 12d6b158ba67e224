// SPDX-License-Identifier: MIT
#include "fuzz_draw_numbers.h"

#include <float.h>
#include <limits.h>
#include <math.h>

static uint64_t state;
static int wildness;

void numbers_start(uint64_t seed)
{
	state = seed;
}

void numbers_wild(int count)
{
	wildness = count;
}

/* splitmix64 */
uint64_t random_word(void)
{
	uint64_t z = state += 0x9e3779b97f4a7c15;

	z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9;
	z = (z ^ z >> 27) * 0x94d049bb133111eb;
	return z ^ z >> 31;
}

int below(int limit)
{
	return (int)(random_word() % (uint64_t)limit);
}

bool one_in(int count)
{
	return below(count) == 0;
}

float any_float(void)
{
	static const float special[] = {
		0,        -0.0f,   1,      -1,      NAN,   INFINITY, -INFINITY, FLT_MAX,
		-FLT_MAX, FLT_MIN, 1e-45f, -1e-45f, 1e20f, -1e20f,   1e-20f,    1e10f,
	};

	if (wildness && one_in(wildness))
		return special[below(16)];
	return ldexpf((float)below(2001) / 1000 - 1, below(8) - 3);
}

void any_floats(float *out, int count)
{
	for (int i = 0; i < count; i++)
		out[i] = any_float();
}

float float_to(float most)
{
	return one_in(20) ? any_float() : most * (float)below(1001) / 1000;
}

int any_int(void)
{
	static const int special[] = { INT_MIN, INT_MIN + 1, -1, 0, 1, 64, INT_MAX - 1, INT_MAX };

	switch (below(4)) {
	case 0:
		return special[below(8)];
	case 1:
		return (int)(uint32_t)random_word();
	default:
		return below(400) - 100;
	}
}
