// SPDX-License-Identifier: MIT
#include <string.h>

#include "view/view.h"

#define FAR 1e6f

static bool set_colour(struct accel_light *light, const char *value)
{
	if (!view_colour(value, light->diffuse))
		return false;
	memcpy(light->specular, light->diffuse, sizeof(light->specular));
	return true;
}

static bool set_ambient(struct accel_light *light, const char *value)
{
	return view_colour(value, light->ambient);
}

static bool set_attenuation(struct accel_light *light, const char *value)
{
	const float *a = light->attenuation;

	return view_numbers(value, 3, 0, FAR, light->attenuation) && a[0] + a[1] + a[2] > 0;
}

static bool set_aim(struct accel_light *light, const char *value)
{
	const float *d = light->spot_direction;

	return view_numbers(value, 3, -FAR, FAR, light->spot_direction) && (d[0] || d[1] || d[2]);
}

static bool set_cutoff(struct accel_light *light, const char *value)
{
	return view_number(value, 0, 90, &light->spot_cutoff) && light->spot_cutoff > 0;
}

static bool set_exponent(struct accel_light *light, const char *value)
{
	return view_number(value, 0, 128, &light->spot_exponent);
}

enum kind { DIRECTION = 1, POINT = 2, SPOT = 4 };

static const struct setting {
	const char *name;
	unsigned int kinds; /* that have it */
	bool (*set)(struct accel_light *light, const char *value);
} settings[] = {
	{ "colour=", DIRECTION | POINT | SPOT, set_colour },
	{ "ambient=", DIRECTION | POINT | SPOT, set_ambient },
	{ "attenuation=", POINT | SPOT, set_attenuation },
	{ "aim=", SPOT, set_aim },
	{ "cutoff=", SPOT, set_cutoff },
	{ "exponent=", SPOT, set_exponent },
};

static bool apply(struct accel_light *light, enum kind kind, const char *text)
{
	for (size_t i = 0; i < sizeof(settings) / sizeof(*settings); i++) {
		size_t length = strlen(settings[i].name);

		if (!strncmp(text, settings[i].name, length) && (settings[i].kinds & kind))
			return settings[i].set(light, text + length);
	}
	return false;
}

static bool find_kind(const char *name, enum kind *kind)
{
	static const char *const names[] = { "direction", "point", "spot" };

	for (int i = 0; i < 3; i++) {
		*kind = 1 << i;
		if (!strcmp(name, names[i]))
			return true;
	}
	return false;
}

static bool begin(struct accel_light *light, enum kind kind, const char *place)
{
	float p[3];

	if (!view_numbers(place, 3, -FAR, FAR, p))
		return false;
	if (kind == DIRECTION) {
		*light = scene_light_direction(p[0], p[1], p[2]);
		return p[0] || p[1] || p[2];
	}
	*light = scene_light_point(p[0], p[1], p[2]);
	if (kind == SPOT) {
		/* At the middle of the mesh, if not said otherwise. */
		for (int i = 0; i < 3; i++)
			light->spot_direction[i] = -p[i];
		light->spot_cutoff = 30;
	}
	return true;
}

bool view_light_parse(const char *text, struct accel_light *light)
{
	char copy[256], *rest = NULL;
	const char *word, *place;
	enum kind kind;

	if (strlen(text) >= sizeof(copy))
		return false;
	memcpy(copy, text, strlen(text) + 1);
	word = strtok_r(copy, ":", &rest);
	place = strtok_r(NULL, ":", &rest);
	if (!word || !place || !find_kind(word, &kind) || !begin(light, kind, place))
		return false;
	while ((word = strtok_r(NULL, ":", &rest)))
		if (!apply(light, kind, word))
			return false;
	return true;
}
