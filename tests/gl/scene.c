// SPDX-License-Identifier: MIT
#include "scene.h"

#include <math.h>

#define DEPTH_ONE 0xffffff
#define STEPS 255.0
/* Depth steps, and pixels along which its change does not matter: scene.h says why. */
#define DEPTH_STEPS 3
#define DEPTH_ALONG (1 / 64.0)

static const enum accel_topology topologies[ORACLE_TOPOLOGIES] = {
	[ORACLE_POINTS] = ACCEL_TOPOLOGY_POINTS,
	[ORACLE_LINES] = ACCEL_TOPOLOGY_LINES,
	[ORACLE_LINE_LOOP] = ACCEL_TOPOLOGY_LINE_LOOP,
	[ORACLE_LINE_STRIP] = ACCEL_TOPOLOGY_LINE_STRIP,
	[ORACLE_TRIANGLES] = ACCEL_TOPOLOGY_TRIANGLES,
	[ORACLE_TRIANGLE_STRIP] = ACCEL_TOPOLOGY_TRIANGLE_STRIP,
	[ORACLE_TRIANGLE_FAN] = ACCEL_TOPOLOGY_TRIANGLE_FAN,
	[ORACLE_QUADS] = ACCEL_TOPOLOGY_QUADS,
	[ORACLE_QUAD_STRIP] = ACCEL_TOPOLOGY_QUAD_STRIP,
	[ORACLE_ONE_POLYGON] = ACCEL_TOPOLOGY_POLYGON,
};

int scene_setup(void **state)
{
	static struct board board;

	board.device = device_open("model:", &board.messages);
	assert_int_equal(accel_target_new(board.device, SCENE_SIDE, SCENE_SIDE, &board.target), 0);
	assert_int_equal(accel_draw_new(board.device, &board.draw), 0);
	assert_int_equal(accel_state_new(&board.state), 0);
	*state = &board;
	return 0;
}

int scene_teardown(void **state)
{
	struct board *board = *state;

	accel_state_free(board->state);
	accel_draw_free(board->draw);
	accel_target_free(board->target);
	accel_device_free(board->device);
	return 0;
}

void scene_init(struct scene *scene, enum oracle_topology topology)
{
	memset(scene, 0, sizeof(*scene));
	oracle_state_init(&scene->gl, SCENE_SIDE, SCENE_SIDE);
	scene->gl.normals = ORACLE_NORMALISED;
	scene->gl.near = 0.125;
	scene->gl.far = 0.875;
	scene->topology = topology;
}

struct oracle_vertex *scene_vertex(struct scene *scene, double x, double y, double z)
{
	struct oracle_vertex *vertex = &scene->vertex[scene->vertices++];

	assert_true(scene->vertices <= SCENE_VERTICES);
	*vertex = (struct oracle_vertex){ { x, y, z, 1 }, { 0, 0, 1 }, { 1, 1, 1, 1 } };
	return vertex;
}

static void floats(const double *from, float *to, int count)
{
	for (int i = 0; i < count; i++)
		to[i] = (float)from[i];
}

static void set_material(struct accel_state *state, const struct oracle_state *gl)
{
	struct accel_material material[ORACLE_SIDES];

	for (int i = 0; i < ORACLE_SIDES; i++) {
		const struct oracle_material *from = &gl->material[i];

		material[i] = (struct accel_material)
			ACCEL_MATERIAL(.shininess = (float)from->shininess);
		floats(from->emission, material[i].emission, 4);
		floats(from->ambient, material[i].ambient, 4);
		floats(from->diffuse, material[i].diffuse, 4);
		floats(from->specular, material[i].specular, 4);
	}
	assert_int_equal(accel_state_set_material(state, &material[0], &material[1]), 0);
}

static void set_lights(struct accel_state *state, const struct oracle_state *gl)
{
	for (int i = 0; i < ORACLE_LIGHTS; i++) {
		const struct oracle_light *from = &gl->light[i];
		struct accel_light light = ACCEL_LIGHT(.enabled = from->enabled,
						       .spot_exponent = (float)from->spot_exponent,
						       .spot_cutoff = (float)from->spot_cutoff);

		floats(from->position, light.position, 4);
		floats(from->ambient, light.ambient, 4);
		floats(from->diffuse, light.diffuse, 4);
		floats(from->specular, light.specular, 4);
		floats(from->attenuation, light.attenuation, 3);
		floats(from->spot_direction, light.spot_direction, 3);
		assert_int_equal(accel_state_set_light(state, i, &light), 0);
	}
}

static void set_view(struct accel_state *state, const struct oracle_state *gl)
{
	float modelview[16], projection[16];
	int height = (int)gl->viewport[3];

	floats(gl->modelview, modelview, 16);
	floats(gl->projection, projection, 16);
	accel_state_set_modelview(state, modelview);
	accel_state_set_projection(state, projection);
	/* The library's rows come from the top. */
	accel_state_set_viewport(state, (int)gl->viewport[0],
				 SCENE_SIDE - height - (int)gl->viewport[1], (int)gl->viewport[2],
				 height);
	accel_state_set_depth_range(state, (float)gl->near, (float)gl->far);
	accel_state_set_depth(state, ACCEL_COMPARE_ALWAYS, true);
}

static void set_planes(struct accel_state *state, const struct oracle_state *gl)
{
	for (int i = 0; i < ORACLE_PLANES; i++) {
		float plane[4];

		floats(gl->plane[i], plane, 4);
		assert_int_equal(accel_state_set_clip_plane(state, i,
							    gl->planes >> i & 1 ? plane : NULL),
				 0);
	}
}

static void set_strokes(struct accel_state *state, const struct oracle_state *gl)
{
	const struct accel_line_style line = ACCEL_LINE_STYLE(.width = (float)gl->line_width,
							      .stipple = (uint16_t)gl->stipple,
							      .repeat = (uint16_t)
										gl->stipple_repeat);
	struct accel_point_style point = ACCEL_POINT_STYLE(.width = (float)gl->point_size,
							   .least = (float)gl->point_least,
							   .most = (float)gl->point_most);

	floats(gl->point_attenuation, point.attenuation, 3);
	assert_int_equal(accel_state_set_line_style(state, &line), 0);
	assert_int_equal(accel_state_set_point_style(state, &point), 0);
}

static enum accel_tracks tracks_of(unsigned int follow)
{
	switch (follow) {
	case ORACLE_EMISSION:
		return ACCEL_TRACKS_EMISSION;
	case ORACLE_AMBIENT:
		return ACCEL_TRACKS_AMBIENT;
	case ORACLE_DIFFUSE:
		return ACCEL_TRACKS_DIFFUSE;
	case ORACLE_SPECULAR:
		return ACCEL_TRACKS_SPECULAR;
	case ORACLE_AMBIENT | ORACLE_DIFFUSE:
		return ACCEL_TRACKS_AMBIENT_DIFFUSE;
	default:
		assert_int_equal(follow, 0);
		return ACCEL_TRACKS_NONE;
	}
}

static void set_state(struct accel_state *state, const struct oracle_state *gl,
		      enum accel_shading shading)
{
	static const enum accel_cull culls[] = { ACCEL_CULL_NONE, ACCEL_CULL_BACK,
						 ACCEL_CULL_FRONT };
	static const enum accel_normals normals[] = { ACCEL_NORMALS_AS_GIVEN, ACCEL_NORMALS_RESCALE,
						      ACCEL_NORMALS_UNIT };
	float ambient[4];

	set_view(state, gl);
	set_planes(state, gl);
	set_strokes(state, gl);
	set_material(state, gl);
	set_lights(state, gl);
	floats(gl->ambient, ambient, 4);
	assert_int_equal(accel_state_set_ambient(state, ambient), 0);
	accel_state_set_lighting(state, gl->lighting);
	accel_state_set_local_viewer(state, gl->local_viewer);
	accel_state_set_two_sided(state, gl->two_sided);
	accel_state_set_cull(state, culls[gl->cull]);
	accel_state_set_front_face(state, gl->front_clockwise);
	accel_state_set_normals(state, normals[gl->normals]);
	accel_state_set_colour_material(state, tracks_of(gl->follow[0]), tracks_of(gl->follow[1]));
	accel_state_set_shading(state, gl->flat ? ACCEL_SHADING_FLAT : shading);
}

static void flip(uint32_t *pixels)
{
	for (int i = 0; i < SCENE_PIXELS / 2; i++) {
		uint32_t *other =
			&pixels[(SCENE_SIDE - 1 - i / SCENE_SIDE) * SCENE_SIDE + i % SCENE_SIDE];
		uint32_t kept = pixels[i];

		pixels[i] = *other;
		*other = kept;
	}
}

void scene_draw(struct board *board, const struct scene *scene, enum accel_shading shading,
		struct drawing *drawing)
{
	static const float black[4] = { 0 };
	float position[SCENE_VERTICES][4], normal[SCENE_VERTICES][3], colour[SCENE_VERTICES][4];
	const struct accel_arrays arrays = ACCEL_ARRAYS(.vertices = (uint32_t)scene->vertices,
							.position = { .data = position },
							.normal = { .data = normal },
							.colour = { .data = colour });
	const struct accel_primitive primitive = { .topology = topologies[scene->topology],
						   .count = (uint32_t)scene->vertices };
	const struct accel_elements elements = ACCEL_ELEMENTS(.primitive = &primitive,
							      .primitives = 1);

	for (int i = 0; i < scene->vertices; i++) {
		floats(scene->vertex[i].position, position[i], 4);
		floats(scene->vertex[i].normal, normal[i], 3);
		floats(scene->vertex[i].colour, colour[i], 4);
	}
	set_state(board->state, &scene->gl, shading);
	assert_int_equal(draw_begin(board->draw, board->target, black, 1), 0);
	assert_int_equal(accel_draw_arrays(board->draw, board->state, &arrays, &elements), 0);
	assert_int_equal(accel_draw_finish(board->draw), 0);
	assert_int_equal(accel_target_read(board->target, ACCEL_PLANE_COLOUR, NULL, drawing->colour,
					   SCENE_SIDE * 4),
			 0);
	assert_int_equal(accel_target_read(board->target, ACCEL_PLANE_DEPTH, NULL, drawing->depth,
					   SCENE_SIDE * 4),
			 0);
	flip(drawing->colour);
	flip(drawing->depth);
}

const struct oracle_picture *scene_work_out(const struct scene *scene)
{
	static struct oracle_pixel pixels[SCENE_PIXELS];
	static struct oracle_picture picture = { SCENE_SIDE, SCENE_SIDE, pixels, false };

	memset(pixels, 0, sizeof(pixels));
	picture.doubtful = false;
	oracle_draw(&scene->gl, scene->topology, scene->vertex, scene->vertices, &picture);
	return &picture;
}

/* Adds up the channels of a pixel. */
static void compare_colour(uint32_t colour, const struct oracle_pixel *pixel, int i,
			   struct difference *difference)
{
	difference->compared++;
	for (int channel = 0; channel < 4; channel++) {
		double off = fabs((double)(colour >> 8 * channel & 255) -
				  STEPS * pixel->colour[channel]) -
			     STEPS * pixel->slack[channel];

		difference->mean += off;
		if (off > difference->colour) {
			difference->colour = off;
			difference->x = i % SCENE_SIDE;
			difference->y = i / SCENE_SIDE;
		}
	}
}

static double depth_off(uint32_t depth, const struct oracle_pixel *pixel)
{
	double off = fabs(depth - pixel->depth * DEPTH_ONE);

	return off - DEPTH_STEPS - (pixel->slack[4] + pixel->slope * DEPTH_ALONG) * DEPTH_ONE;
}

struct difference scene_compare(const struct drawing *drawing, const struct oracle_picture *picture,
				double inside)
{
	struct difference difference = { 0 };

	for (int i = 0; i < SCENE_PIXELS; i++) {
		const struct oracle_pixel *pixel = &picture->pixel[i];
		/* The depth range ends before what the target is cleared to. */
		bool drawn = drawing->depth[i] != DEPTH_ONE;

		difference.covered += drawn || pixel->drawn;
		if (pixel->either)
			continue;
		difference.coverage += drawn != pixel->drawn;
		if (!drawn || !pixel->drawn)
			continue;
		difference.depth = fmax(difference.depth, depth_off(drawing->depth[i], pixel));
		if (pixel->inside >= inside)
			compare_colour(drawing->colour[i], pixel, i, &difference);
	}
	if (difference.compared)
		difference.mean /= 4.0 * difference.compared;
	return difference;
}

void scene_assert(struct board *board, const struct scene *scene, double steps, int least)
{
	static struct drawing drawing;
	const struct oracle_picture *picture = scene_work_out(scene);
	struct difference d;

	scene_draw(board, scene, ACCEL_SHADING_GOURAUD, &drawing);
	d = scene_compare(&drawing, picture, 0);
	if (d.coverage)
		fail_msg("%d of %d pixels are drawn by one only", d.coverage, d.covered);
	if (d.depth > 0)
		fail_msg("depth is %g steps farther off than it may be", d.depth);
	if (d.colour > steps) {
		int i = d.y * SCENE_SIDE + d.x;

		fail_msg("pixel %d,%d is %08x, and not %.1f, %.1f, %.1f, %.1f of 255", d.x, d.y,
			 drawing.colour[i], STEPS * picture->pixel[i].colour[0],
			 STEPS * picture->pixel[i].colour[1], STEPS * picture->pixel[i].colour[2],
			 STEPS * picture->pixel[i].colour[3]);
	}
	assert_true(d.compared >= least);
}
