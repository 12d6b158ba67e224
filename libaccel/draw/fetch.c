// SPDX-License-Identifier: MIT
/* Elements of a mesh's arrays, as floats, from where the program has them. */
#include <errno.h>
#include <string.h>

#include "draw/kernel.h"

static const struct fetch_attribute {
	const char *name;
	uint8_t least, most; /* components */
} attributes[] = {
	[ACCEL_ATTRIBUTE_POSITION] = { "positions", 2, 3 },
	[ACCEL_ATTRIBUTE_NORMAL] = { "normals", 3, 3 },
	[ACCEL_ATTRIBUTE_COLOUR] = { "colours", 3, 4 },
};

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
	if (array->type == ACCEL_TYPE_FLOAT ||
	    (array->type == ACCEL_TYPE_UBYTE && array->normalised &&
	     attribute == ACCEL_ATTRIBUTE_COLOUR))
		return 0;
	accel_device_message(device, "%s of type %u: so far they are ACCEL_TYPE_FLOAT%s", of->name,
			     array->type,
			     attribute == ACCEL_ATTRIBUTE_COLOUR ?
				     ", or ACCEL_TYPE_UBYTE and normalised" :
				     "");
	return -EINVAL;
}

int accel_fetch_init(struct accel_fetch *fetch, struct accel_device *device,
		     enum accel_attribute attribute, const struct accel_array *array)
{
	uint8_t all = attributes[attribute].most;
	int err = array->data ? fetch_check(device, attribute, array) : 0;

	*fetch = (struct accel_fetch){ .data = NULL };
	if (err || !array->data)
		return err;
	fetch->data = array->data;
	fetch->bytes = array->type == ACCEL_TYPE_UBYTE;
	fetch->components = array->components ? array->components : all;
	fetch->step = array->stride;
	if (!fetch->step)
		fetch->step = fetch->components * (fetch->bytes ? 1 : sizeof(float));
	if (array->constant)
		fetch->step = 0;
	return 0;
}

void accel_fetch_element(const struct accel_fetch *fetch, uint32_t number, float out[4])
{
	const uint8_t *from = fetch->data + number * fetch->step;

	out[2] = 0;
	out[3] = 1;
	if (!fetch->bytes) {
		memcpy(out, from, fetch->components * sizeof(*out));
		return;
	}
	for (int i = 0; i < fetch->components; i++)
		out[i] = (float)from[i] / 255;
}

static float fetch_number(const struct accel_fetch *fetch, const uint8_t *from)
{
	float number;

	if (fetch->bytes)
		return (float)*from / 255;
	memcpy(&number, from, sizeof(number));
	return number;
}

void accel_fetch_batch(const struct accel_fetch *fetch, const uint32_t *number, int count,
		       int components, float (*out)[ACCEL_BATCH])
{
	const size_t step = fetch->step, size = fetch->bytes ? 1 : sizeof(float);

	for (int i = 0; i < components; i++) {
		bool there = i < fetch->components;
		const uint8_t *from = fetch->data + (there ? (size_t)i * size : 0);

		for (int j = 0; j < count && there; j++)
			out[i][j] = fetch_number(fetch, from + number[j] * step);
		for (int j = 0; j < count && !there; j++)
			out[i][j] = i < 3 ? 0 : 1;
	}
}
