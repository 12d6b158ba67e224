// SPDX-License-Identifier: MIT
#include <getopt.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "view/view.h"

#ifndef GLOSS_RELEASE
#define GLOSS_RELEASE "0.1"
#endif

#define DEFAULT_MATERIAL "ivory"
#define TURNTABLE_MAX 9999

void view_error(const char *what, const char *where, const char *hint)
{
	fprintf(stderr, "gloss-view: %s: %s: %s\n", what, where, hint);
}

/* ---- values: each says whether it understood ---- */

static bool set_device(struct view_options *options, const char *value)
{
	options->device = value;
	return true;
}

static bool set_size(struct view_options *options, const char *value)
{
	char *end;
	long width = strtol(value, &end, 10), height;

	if (end == value || *end != 'x')
		return false;
	value = end + 1;
	height = strtol(value, &end, 10);
	if (end == value || *end || width < 1 || width > VIEW_SIZE_MAX || height < 1 ||
	    height > VIEW_SIZE_MAX)
		return false;
	options->width = (int)width;
	options->height = (int)height;
	return true;
}

static bool set_shading(struct view_options *options, const char *value)
{
	for (int i = ACCEL_SHADING_GOURAUD; i <= ACCEL_SHADING_FLAT; i++) {
		if (!strcmp(value, view_shading_name(i))) {
			options->shading = i;
			return true;
		}
	}
	return false;
}

static bool set_material(struct view_options *options, const char *value)
{
	const struct accel_material *material = view_material_find(value);

	if (material)
		options->material = *material;
	options->recoloured = true;
	return material != NULL;
}

static bool set_ambient(struct view_options *options, const char *value)
{
	options->recoloured = true;
	return view_colour(value, options->material.ambient);
}

static bool set_diffuse(struct view_options *options, const char *value)
{
	options->recoloured = true;
	return view_colour(value, options->material.diffuse);
}

static bool set_specular(struct view_options *options, const char *value)
{
	return view_colour(value, options->material.specular);
}

static bool set_shininess(struct view_options *options, const char *value)
{
	return view_number(value, 0, 1000, &options->material.shininess);
}

static bool set_light(struct view_options *options, const char *value)
{
	if (options->lights == ACCEL_LIGHTS)
		return false;
	return view_light_parse(value, &options->light[options->lights++]);
}

static bool set_two_sided(struct view_options *options, const char *value)
{
	(void)value;
	options->two_sided = true;
	return true;
}

static bool set_smooth(struct view_options *options, const char *value)
{
	(void)value;
	options->reading.normals = MESH_NORMALS_SMOOTH;
	return true;
}

static bool set_facets(struct view_options *options, const char *value)
{
	(void)value;
	options->reading.normals = MESH_NORMALS_FACETS;
	return true;
}

static bool set_crease(struct view_options *options, const char *value)
{
	return view_number(value, 0, 180, &options->reading.crease);
}

static bool set_up(struct view_options *options, const char *value)
{
	static const struct {
		const char *axis;
		float upright[2];
	} axes[] = {
		{ "x", { 0, 90 } },   { "y", { 0, 0 } },    { "z", { -90, 0 } },
		{ "-x", { 0, -90 } }, { "-y", { 0, 180 } }, { "-z", { 90, 0 } },
	};

	for (size_t i = 0; i < sizeof(axes) / sizeof(*axes); i++) {
		if (!strcmp(value, axes[i].axis)) {
			memcpy(options->upright, axes[i].upright, sizeof(options->upright));
			return true;
		}
	}
	return false;
}

static bool set_rotate(struct view_options *options, const char *value)
{
	return view_numbers(value, 3, -3600, 3600, options->rotate);
}

static bool set_camera(struct view_options *options, const char *value)
{
	return view_numbers(value, 2, -3600, 3600, options->camera);
}

static bool set_zoom(struct view_options *options, const char *value)
{
	return view_number(value, 0.01f, 100, &options->zoom);
}

static bool set_fov(struct view_options *options, const char *value)
{
	return view_number(value, 0, 120, &options->fov) &&
	       (options->fov == 0 || options->fov >= 1);
}

static bool set_background(struct view_options *options, const char *value)
{
	return view_colour(value, options->background);
}

static bool set_out(struct view_options *options, const char *value)
{
	options->out = value;
	return picture_named(value);
}

static bool set_turntable(struct view_options *options, const char *value)
{
	char *end;
	long frames = strtol(value, &end, 10);

	if (end == value || *end || frames < 1 || frames > TURNTABLE_MAX)
		return false;
	options->turntable = (int)frames;
	return true;
}

static bool set_compare(struct view_options *options, const char *value)
{
	options->compare = value;
	return picture_named(value) && strcmp(value, "-") != 0;
}

static bool set_stats(struct view_options *options, const char *value)
{
	(void)value;
	options->stats = true;
	return true;
}

static bool set_window(struct view_options *options, const char *value)
{
	(void)value;
	options->window = true;
	return true;
}

static bool show_version(struct view_options *options, const char *value)
{
	(void)value;
	puts("gloss-view " GLOSS_RELEASE);
	options->done = true;
	return true;
}

static bool show_help(struct view_options *options, const char *value);

/* ---- the list ---- */

#define COLOUR_HINT "give #rrggbb, R,G,B or one number, 0 to 1"
/* Starts a line of help under the line before. */
#define NEXT "\n                       "

static const struct view_option {
	const char *name;
	const char *argument; /* NULL: takes none */
	const char *help;
	const char *hint; /* what a value has to be */
	bool (*set)(struct view_options *options, const char *value);
} list[] = {
	{ "device", "NAME",
	  "board to draw on: drm:, usb:, model:, sim:, or auto (the default), the first of" NEXT
	  "them that opens; gloss-info --list names the boards there are",
	  "", set_device },
	{ "size", "WxH", "pixels of the picture, each side up to 16384; 640x480 if not given",
	  "give WIDTHxHEIGHT, each 1 to 16384", set_size },
	{ "shading", "NAME", "gouraud, adaptive (the default), quadratic, flat",
	  "give gouraud, adaptive, quadratic or flat", set_shading },
	{ "material", "NAME", "a material of the list below, instead of the mesh's own colours",
	  "see the list of gloss-view --help", set_material },
	{ "ambient", "COLOUR", "ambient reflectance, instead of the material's", COLOUR_HINT,
	  set_ambient },
	{ "diffuse", "COLOUR", "diffuse reflectance", COLOUR_HINT, set_diffuse },
	{ "specular", "COLOUR", "specular reflectance", COLOUR_HINT, set_specular },
	{ "shininess", "N", "specular exponent", "give a number from 0 to 1000", set_shininess },
	{ "light", "LIGHT", "a light, up to 8 times; see below",
	  "give KIND:X,Y,Z[:SETTING=VALUE]..., at most 8 times; see gloss-view --help", set_light },
	{ "two-sided", NULL, "draw back faces too, lit from behind", "", set_two_sided },
	{ "crease", "DEGREES",
	  "where a file has no normals, edges at which faces meet at more are sharp;" NEXT
	  "30 if not given",
	  "give degrees from 0 to 180", set_crease },
	{ "smooth", NULL, "no sharp edges, also where the file has its own normals", "",
	  set_smooth },
	{ "facets", NULL, "all edges sharp, also where the file has its own normals", "",
	  set_facets },
	{ "up", "AXIS", "what is up in the mesh: x, y (the default), z, -x, -y or -z",
	  "give x, y, z, -x, -y or -z", set_up },
	{ "rotate", "X,Y,Z", "turn the mesh about its axes, degrees",
	  "give three numbers of degrees", set_rotate },
	{ "camera", "RIGHT,UP", "move the eye around the mesh, degrees; 30,20 if not given",
	  "give two numbers of degrees", set_camera },
	{ "zoom", "FACTOR", "enlarge; 1 fits the mesh to the picture",
	  "give a factor from 0.01 to 100", set_zoom },
	{ "fov", "DEGREES", "angle of view from bottom to top, 30 if not given; 0: no perspective",
	  "give 0, or degrees from 1 to 120", set_fov },
	{ "background", "COLOUR", "colour where the mesh is not", COLOUR_HINT, set_background },
	{ "out", "FILE",
	  "write the picture, as PNG or PPM by the ending of FILE; - is standard output",
	  "give a name that ends in .png or .ppm, or -", set_out },
	{ "turntable", "N", "write N numbered pictures of one turn, FILE-0000.png and so on",
	  "give a number of frames from 1 to 9999", set_turntable },
	{ "compare", "FILE",
	  "write Gouraud, the chosen shading and per-pixel Phong side by side, and print" NEXT
	  "how far the first two are from the last",
	  "give a name that ends in .png or .ppm", set_compare },
	{ "stats", NULL, "print what was drawn, and clocks where the board counts them", "",
	  set_stats },
	{ "window", NULL,
	  "show the mesh; drag to turn, with the right button to move, wheel to zoom," NEXT
	  "arrows to fly and look, g a q f to shade, t both sides, s to save a picture," NEXT
	  "r as at the beginning, Esc to leave",
	  "", set_window },
	{ "help", NULL, "print this and leave; -h too, and -o for --out", "", show_help },
	{ "version", NULL, "print the version and leave", "", show_version },
};

enum { OPTIONS = sizeof(list) / sizeof(*list) };

static bool show_help(struct view_options *options, const char *value)
{
	(void)value;
	puts("usage: gloss-view [OPTION]... MESH\n"
	     "Draws a mesh on a Gloss board. MESH is an OBJ, PLY, 3DS, glTF or STL file, or\n"
	     "another that assimp reads (DAE, FBX, OFF, 3MF and more), or a shape:\n" MESH_SHAPES
	     ".\n");
	for (int i = 0; i < OPTIONS; i++) {
		char name[40];

		snprintf(name, sizeof(name), "--%s%s%s", list[i].name, list[i].argument ? " " : "",
			 list[i].argument ? list[i].argument : "");
		printf("  %-20s %s\n", name, list[i].help);
	}
	printf("\nA COLOUR is #rrggbb, R,G,B or one number for grey, 0 to 1.\n"
	       "Materials: %s.\nWithout --material it is the mesh's own\n"
	       "colours, and " DEFAULT_MATERIAL " if it has none.\n\n"
	       "A LIGHT is direction:X,Y,Z or point:X,Y,Z or spot:X,Y,Z. X is to the right, Y up,\n"
	       "Z towards the eye, from the middle of the mesh, whose radius is 1. Settings may\n"
	       "follow: :colour=COLOUR :ambient=COLOUR, for a point or spot :attenuation=C,L,Q,\n"
	       "for a spot :aim=X,Y,Z :cutoff=DEGREES :exponent=E.\n",
	       view_material_names());
	options->done = true;
	return true;
}

/* ---- parsing ---- */

static void set_defaults(struct view_options *options)
{
	memset(options, 0, sizeof(*options));
	options->device = "auto";
	options->width = 640;
	options->height = 480;
	options->shading = ACCEL_SHADING_ADAPTIVE;
	options->zoom = 1;
	options->fov = 30;
	options->camera[0] = 30;
	options->camera[1] = 20;
	options->reading.crease = MESH_CREASE;
	set_material(options, DEFAULT_MATERIAL);
	options->recoloured = false;
	view_colour("#1c2430", options->background);
}

static void default_lights(struct view_options *options)
{
	if (options->lights)
		return;
	set_light(options, "direction:-0.5,0.7,0.9");
	set_light(options, "direction:0.9,0.2,0.3:colour=#404a58");
}

static int bad_usage(const char *what, const char *where, const char *hint)
{
	view_error(what, where, hint);
	return VIEW_USAGE;
}

static int apply(struct view_options *options, const struct view_option *option, const char *value)
{
	char where[128];

	if (option->set(options, value))
		return VIEW_OK;
	snprintf(where, sizeof(where), "--%s %s", option->name, value);
	return bad_usage("bad value", where, option->hint);
}

static const struct view_option *option_called(const char *name)
{
	int i = 0;

	while (strcmp(list[i].name, name) != 0)
		i++;
	return &list[i];
}

static int parse_options(struct view_options *options, int argc, char **argv)
{
	struct option known[OPTIONS + 1] = { 0 };
	int index, ret = VIEW_OK;

	for (int i = 0; i < OPTIONS; i++) {
		known[i].name = list[i].name;
		known[i].has_arg = list[i].argument ? required_argument : no_argument;
	}
	opterr = 0;
	while (ret == VIEW_OK && !options->done) {
		switch (getopt_long(argc, argv, ":ho:", known, &index)) {
		case -1:
			return VIEW_OK;
		case 0:
			ret = apply(options, &list[index], optarg);
			break;
		case 'h':
			show_help(options, NULL);
			break;
		case 'o':
			ret = apply(options, option_called("out"), optarg);
			break;
		case ':':
			return bad_usage("value missing", argv[optind - 1],
					 "see gloss-view --help");
		default:
			return bad_usage("unknown option", argv[optind - 1],
					 "see gloss-view --help");
		}
	}
	return ret;
}

/* A picture that goes there leaves no room for anything else. */
static int check_stdout(const struct view_options *options)
{
	if (options->turntable || options->stats || options->compare)
		return bad_usage("not together", "--out - and --turntable, --stats or --compare",
				 "give --out the name of a file");
	if (isatty(STDOUT_FILENO))
		return bad_usage("bad value", "--out -",
				 "standard output is a terminal, "
				 "give the name of a file or a pipe");
	return VIEW_OK;
}

/* Whether the options make sense together. */
static int check(const struct view_options *options)
{
	if (!options->mesh)
		return bad_usage("no mesh", "command line",
				 "give a file or a shape, see gloss-view --help");
	if (options->turntable && !options->out)
		return bad_usage("nowhere to write", "--turntable", "give --out FILE too");
	if (options->out && !strcmp(options->out, "-"))
		return check_stdout(options);
	if (options->turntable && options->window)
		return bad_usage("not together", "--turntable and --window", "give one of them");
	if (!options->out && !options->compare && !options->stats && !options->window)
		return bad_usage("nothing to do", "command line",
				 "give --out, --compare, --stats or --window");
	return VIEW_OK;
}

int view_options_parse(struct view_options *options, int argc, char **argv)
{
	int ret;

	set_defaults(options);
	ret = parse_options(options, argc, argv);
	if (ret != VIEW_OK || options->done)
		return ret;
	if (optind < argc)
		options->mesh = argv[optind++];
	if (optind < argc)
		return bad_usage("one mesh too many", argv[optind], "give one file or shape");
	default_lights(options);
	return check(options);
}
