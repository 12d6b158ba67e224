// SPDX-License-Identifier: MIT
#include <stdio.h>
#include <string.h>

#include "view/view.h"

/* The classic OpenGL materials, and a few with wide highlights to try shading with. */
static const struct named_material {
	const char *name;
	struct accel_material material;
} materials[] = {
/* clang-format off */
#define MATERIAL(name, ar, ag, ab, dr, dg, db, sr, sg, sb, n) \
	{ name, ACCEL_MATERIAL(.emission = { 0, 0, 0, 1 }, .ambient = { ar, ag, ab, 1 }, \
			       .diffuse = { dr, dg, db, 1 }, .specular = { sr, sg, sb, 1 }, \
			       .shininess = (n)) }
	/* clang-format on */
	MATERIAL("ivory", 0.16f, 0.15f, 0.13f, 0.72f, 0.67f, 0.58f, 0.45f, 0.45f, 0.45f, 60),
	MATERIAL("plastic", 0.05f, 0.07f, 0.11f, 0.15f, 0.32f, 0.60f, 0.60f, 0.60f, 0.60f, 40),
	MATERIAL("red-plastic", 0.08f, 0.02f, 0.02f, 0.62f, 0.07f, 0.06f, 0.65f, 0.60f, 0.60f, 32),
	MATERIAL("gold", 0.24725f, 0.1995f, 0.0745f, 0.75164f, 0.60648f, 0.22648f, 0.628281f,
		 0.555802f, 0.366065f, 51.2f),
	MATERIAL("silver", 0.19225f, 0.19225f, 0.19225f, 0.50754f, 0.50754f, 0.50754f, 0.508273f,
		 0.508273f, 0.508273f, 51.2f),
	MATERIAL("brass", 0.329412f, 0.223529f, 0.027451f, 0.780392f, 0.568627f, 0.113725f,
		 0.992157f, 0.941176f, 0.807843f, 27.8974f),
	MATERIAL("bronze", 0.2125f, 0.1275f, 0.054f, 0.714f, 0.4284f, 0.18144f, 0.393548f,
		 0.271906f, 0.166721f, 25.6f),
	MATERIAL("copper", 0.19125f, 0.0735f, 0.0225f, 0.7038f, 0.27048f, 0.0828f, 0.256777f,
		 0.137622f, 0.086014f, 12.8f),
	MATERIAL("chrome", 0.25f, 0.25f, 0.25f, 0.4f, 0.4f, 0.4f, 0.774597f, 0.774597f, 0.774597f,
		 76.8f),
	MATERIAL("jade", 0.135f, 0.2225f, 0.1575f, 0.54f, 0.89f, 0.63f, 0.316228f, 0.316228f,
		 0.316228f, 12.8f),
	MATERIAL("emerald", 0.0215f, 0.1745f, 0.0215f, 0.07568f, 0.61424f, 0.07568f, 0.633f,
		 0.727811f, 0.633f, 76.8f),
	MATERIAL("obsidian", 0.05375f, 0.05f, 0.06625f, 0.18275f, 0.17f, 0.22525f, 0.332741f,
		 0.328634f, 0.346435f, 38.4f),
	MATERIAL("pearl", 0.25f, 0.20725f, 0.20725f, 1, 0.829f, 0.829f, 0.296648f, 0.296648f,
		 0.296648f, 11.264f),
	MATERIAL("ruby", 0.1745f, 0.01175f, 0.01175f, 0.61424f, 0.04136f, 0.04136f, 0.727811f,
		 0.626959f, 0.626959f, 76.8f),
	MATERIAL("turquoise", 0.1f, 0.18725f, 0.1745f, 0.396f, 0.74151f, 0.69102f, 0.297254f,
		 0.30829f, 0.306678f, 12.8f),
	MATERIAL("rubber", 0.02f, 0.02f, 0.02f, 0.10f, 0.10f, 0.10f, 0.4f, 0.4f, 0.4f, 10),
#undef MATERIAL
};

const struct accel_material *view_material_find(const char *name)
{
	for (size_t i = 0; i < sizeof(materials) / sizeof(*materials); i++)
		if (!strcmp(materials[i].name, name))
			return &materials[i].material;
	return NULL;
}

const char *view_material_names(void)
{
	static char names[sizeof(materials) / sizeof(*materials) * 16];
	size_t used = 0;

	for (size_t i = 0; i < sizeof(materials) / sizeof(*materials); i++)
		used += snprintf(names + used, sizeof(names) - used, i ? ", %s" : "%s",
				 materials[i].name);
	return names;
}
