/* SPDX-License-Identifier: MIT */
/*
 * Numbers of twice a double's digits, as the sum of two doubles (Dekker 1971), up to 2^900. What
 * they rely on is that each operation rounds by itself: the build allows no fused ones.
 */
#ifndef ACCEL_DRAW_WIDE_H
#define ACCEL_DRAW_WIDE_H

struct accel_wide {
	double high, low;
};

/* Exact. */
static inline struct accel_wide accel_wide_of_sum(double a, double b)
{
	double sum = a + b, part = sum - a;

	return (struct accel_wide){ sum, (a - (sum - part)) + (b - part) };
}

/* The upper half of a double's digits. */
static inline double accel_wide_upper(double a)
{
	double scaled = a * 134217729; /* 2^27 + 1 */

	return scaled - (scaled - a);
}

/* Exact. */
static inline struct accel_wide accel_wide_of_product(double a, double b)
{
	double product = a * b, a1 = accel_wide_upper(a), b1 = accel_wide_upper(b);
	double a2 = a - a1, b2 = b - b1;

	return (struct accel_wide){ product, ((a1 * b1 - product) + a1 * b2 + a2 * b1) + a2 * b2 };
}

static inline struct accel_wide accel_wide_add(struct accel_wide a, struct accel_wide b)
{
	struct accel_wide sum = accel_wide_of_sum(a.high, b.high);
	struct accel_wide rest = accel_wide_of_sum(a.low, b.low);

	sum = accel_wide_of_sum(sum.high, sum.low + rest.high);
	return accel_wide_of_sum(sum.high, sum.low + rest.low);
}

static inline struct accel_wide accel_wide_negative(struct accel_wide a)
{
	return (struct accel_wide){ -a.high, -a.low };
}

static inline struct accel_wide accel_wide_scale(struct accel_wide a, double b)
{
	struct accel_wide product = accel_wide_of_product(a.high, b);

	return accel_wide_of_sum(product.high, product.low + a.low * b);
}

static inline struct accel_wide accel_wide_multiply(struct accel_wide a, struct accel_wide b)
{
	struct accel_wide product = accel_wide_of_product(a.high, b.high);

	return accel_wide_of_sum(product.high, product.low + (a.high * b.low + a.low * b.high));
}

static inline struct accel_wide accel_wide_divide(struct accel_wide a, struct accel_wide b)
{
	struct accel_wide quotient = { a.high / b.high, 0 }, rest;

	rest = accel_wide_add(a, accel_wide_negative(accel_wide_scale(b, quotient.high)));
	quotient.low = rest.high / b.high;
	return quotient;
}

#endif
