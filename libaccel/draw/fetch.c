// SPDX-License-Identifier: MIT
/* Elements of arrays, as floats, from where the program has them. */
#include <errno.h>
#include <string.h>

#include "draw/kernel.h"

/* What an attribute may consist of. */
static const struct fetch_attribute {
	const char *name;
	uint8_t least, most;
} attributes[] = {
	[ACCEL_ATTRIBUTE_POSITION] = { "positions", 2, 4 },
	[ACCEL_ATTRIBUTE_NORMAL] = { "normals", 3, 3 },
	[ACCEL_ATTRIBUTE_COLOUR] = { "colours", 3, 4 },
	[ACCEL_ATTRIBUTE_EDGE] = { "edge flags", 1, 1 },
};

/* A number of a normalised type is (factor * number + add) / divisor (OpenGL 1.5, table 2.9). */
static const struct fetch_type {
	uint8_t size;
	bool integer;
	double factor, add, divisor;
} types[] = {
	[ACCEL_TYPE_FLOAT] = { .size = 4 },
	[ACCEL_TYPE_DOUBLE] = { .size = 8 },
	[ACCEL_TYPE_FIXED] = { .size = 4 },
	[ACCEL_TYPE_BYTE] = { 1, true, 2, 1, UINT8_MAX },
	[ACCEL_TYPE_UBYTE] = { 1, true, 1, 0, UINT8_MAX },
	[ACCEL_TYPE_SHORT] = { 2, true, 2, 1, UINT16_MAX },
	[ACCEL_TYPE_USHORT] = { 2, true, 1, 0, UINT16_MAX },
	[ACCEL_TYPE_INT] = { 4, true, 2, 1, UINT32_MAX },
	[ACCEL_TYPE_UINT] = { 4, true, 1, 0, UINT32_MAX },
};
#define TYPES (sizeof(types) / sizeof(types[0]))

#define FIXED_ONE 65536.0

static int fetch_check(struct accel_device *device, enum accel_attribute attribute,
		       const struct accel_array *array)
{
	const struct fetch_attribute *of = &attributes[attribute];

	if (array->components && (array->components < of->least || array->components > of->most)) {
		accel_device_message(device, "%s of %u components: they have %u to %u", of->name,
				     array->components, of->least, of->most);
		return -EINVAL;
	}
	for (size_t i = 0; i < sizeof(array->reserved); i++)
		if (array->reserved[i]) {
			accel_device_message(device, "%s whose reserved bytes are set", of->name);
			return -EINVAL;
		}
	if ((unsigned int)array->type < TYPES)
		return 0;
	accel_device_message(device, "%s of type %u, which is none of ACCEL_TYPE_*", of->name,
			     array->type);
	return -EINVAL;
}

int accel_fetch_init(struct accel_fetch *fetch, struct accel_device *device,
		     enum accel_attribute attribute, const struct accel_array *array)
{
	int err = array->data ? fetch_check(device, attribute, array) : 0;
	const struct fetch_type *type;

	*fetch = (struct accel_fetch){ .data = NULL };
	if (err || !array->data)
		return err;
	type = &types[array->type];
	fetch->data = array->data;
	fetch->type = array->type;
	fetch->size = type->size;
	fetch->components = array->components ? array->components : attributes[attribute].most;
	fetch->factor = fetch->divisor = 1;
	if (type->integer && array->normalised) {
		fetch->factor = type->factor;
		fetch->add = type->add;
		fetch->divisor = type->divisor;
	}
	if (array->type == ACCEL_TYPE_FIXED)
		fetch->divisor = FIXED_ONE;
	fetch->step = array->stride ? array->stride : (size_t)fetch->components * fetch->size;
	if (array->constant)
		fetch->step = 0;
	return 0;
}

/* Component @i of @count elements, of type @type. */
#define FETCH_TYPE(name, type)                                                                   \
	static void fetch_##name(const struct accel_fetch *fetch, int i, const uint32_t *number, \
				 int count, float *out)                                          \
	{                                                                                        \
		const uint8_t *data = fetch->data + (size_t)i * sizeof(type);                    \
		const double factor = fetch->factor, add = fetch->add, divisor = fetch->divisor; \
                                                                                                 \
		for (int j = 0; j < count; j++) {                                                \
			type value;                                                              \
                                                                                                 \
			memcpy(&value, data + number[j] * fetch->step, sizeof(value));           \
			out[j] = (float)((factor * (double)value + add) / divisor);              \
		}                                                                                \
	}

FETCH_TYPE(double, double)
FETCH_TYPE(byte, int8_t)
FETCH_TYPE(ubyte, uint8_t)
FETCH_TYPE(short, int16_t)
FETCH_TYPE(ushort, uint16_t)
FETCH_TYPE(int, int32_t)
FETCH_TYPE(uint, uint32_t)

static void fetch_float(const struct accel_fetch *fetch, int i, const uint32_t *number, int count,
			float *out)
{
	const uint8_t *data = fetch->data + (size_t)i * sizeof(*out);

	for (int j = 0; j < count; j++)
		memcpy(&out[j], data + number[j] * fetch->step, sizeof(*out));
}

static void fetch_component(const struct accel_fetch *fetch, int i, const uint32_t *number,
			    int count, float *out)
{
	static void (*const fetch_type[TYPES])(const struct accel_fetch *, int, const uint32_t *,
					       int, float *) = {
		[ACCEL_TYPE_FLOAT] = fetch_float,   [ACCEL_TYPE_DOUBLE] = fetch_double,
		[ACCEL_TYPE_FIXED] = fetch_int,     [ACCEL_TYPE_BYTE] = fetch_byte,
		[ACCEL_TYPE_UBYTE] = fetch_ubyte,   [ACCEL_TYPE_SHORT] = fetch_short,
		[ACCEL_TYPE_USHORT] = fetch_ushort, [ACCEL_TYPE_INT] = fetch_int,
		[ACCEL_TYPE_UINT] = fetch_uint,
	};

	if (i < fetch->components) {
		fetch_type[fetch->type](fetch, i, number, count, out);
		return;
	}
	for (int j = 0; j < count; j++)
		out[j] = i < 3 ? 0 : 1;
}

void accel_fetch_element(const struct accel_fetch *fetch, uint32_t number, float out[4])
{
	for (int i = 0; i < 4; i++)
		fetch_component(fetch, i, &number, 1, &out[i]);
}

void accel_fetch_batch(const struct accel_fetch *fetch, const uint32_t *number, int count,
		       int components, float (*out)[ACCEL_BATCH])
{
	for (int i = 0; i < components; i++)
		fetch_component(fetch, i, number, count, out[i]);
}
