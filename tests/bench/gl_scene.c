// SPDX-License-Identifier: MIT
#include <math.h>
#include <stdio.h>

#include "gl_scene.h"
#include "scene/matrix.h"

/* ---- fixed function ---- */

static void set_material(const struct accel_material *material)
{
	glMaterialfv(GL_FRONT_AND_BACK, GL_EMISSION, material->emission);
	glMaterialfv(GL_FRONT_AND_BACK, GL_AMBIENT, material->ambient);
	glMaterialfv(GL_FRONT_AND_BACK, GL_DIFFUSE, material->diffuse);
	glMaterialfv(GL_FRONT_AND_BACK, GL_SPECULAR, material->specular);
	glMaterialf(GL_FRONT_AND_BACK, GL_SHININESS, material->shininess);
}

/* While the modelview matrix is the identity: positions are in eye space. */
static void set_light(GLenum name, const struct accel_light *light)
{
	if (!light->enabled) {
		glDisable(name);
		return;
	}
	glEnable(name);
	glLightfv(name, GL_POSITION, light->position);
	glLightfv(name, GL_AMBIENT, light->ambient);
	glLightfv(name, GL_DIFFUSE, light->diffuse);
	glLightfv(name, GL_SPECULAR, light->specular);
}

void gl_scene_set_fixed(const struct scene *scene)
{
	glMatrixMode(GL_PROJECTION);
	glLoadMatrixf(scene->projection);
	glMatrixMode(GL_MODELVIEW);
	glLoadIdentity();
	glEnable(GL_LIGHTING);
	glEnable(GL_NORMALIZE);
	glLightModelfv(GL_LIGHT_MODEL_AMBIENT, scene->ambient);
	glLightModeli(GL_LIGHT_MODEL_LOCAL_VIEWER, scene->local_viewer);
	set_material(&scene->material[0]);
	for (int i = 0; i < ACCEL_LIGHTS; i++)
		set_light(GL_LIGHT0 + i, &scene->light[i]);
	glLoadMatrixf(scene->modelview);
}

/* ---- per pixel ---- */

static const char vertex_shader[] = "#version 120\n"
				    "uniform mat4 modelview, projection;\n"
				    "uniform mat3 turn;\n"
				    "attribute vec3 position, normal;\n"
				    "varying vec3 at, upright;\n"
				    "void main()\n"
				    "{\n"
				    "	vec4 eye = modelview * vec4(position, 1.0);\n"
				    "	at = eye.xyz;\n"
				    "	upright = normalize(turn * normal);\n"
				    "	gl_Position = projection * eye;\n"
				    "}\n";

/* With LIGHTS and VIEWER defined before it. Without a branch, which llvmpipe is slower with. */
static const char fragment_shader[] =
	"uniform vec3 toward[LIGHTS], diffuse[LIGHTS], specular[LIGHTS];\n"
	"uniform vec4 base;\n"
	"uniform float exponent;\n"
	"varying vec3 at, upright;\n"
	"void main()\n"
	"{\n"
	"	vec3 n = normalize(upright);\n"
	"	vec3 viewer = VIEWER;\n"
	"	vec3 light = base.rgb;\n"
	"	for (int i = 0; i < LIGHTS; i++) {\n"
	"		float cosine = dot(n, toward[i]);\n"
	"		vec3 between = normalize(toward[i] + viewer);\n"
	"		float highlight = pow(max(dot(n, between), 0.0), exponent);\n"
	"		vec3 lit = diffuse[i] * cosine + specular[i] * highlight;\n"
	"		light += cosine > 0.0 ? lit : vec3(0.0);\n"
	"	}\n"
	"	gl_FragColor = vec4(light, base.a);\n"
	"}\n";

static int lights(const struct scene *scene)
{
	int count = 0;

	for (int i = 0; i < ACCEL_LIGHTS; i++)
		count += scene->light[i].enabled;
	return count;
}

static void attach(GLuint program, GLenum kind, const char *head, const char *text)
{
	const char *const parts[2] = { head, text };
	GLuint shader = glCreateShader(kind);

	glShaderSource(shader, 2, parts, NULL);
	glCompileShader(shader);
	glAttachShader(program, shader);
	glDeleteShader(shader);
}

GLuint gl_scene_program(const struct scene *scene)
{
	GLuint program = glCreateProgram();
	char head[128];
	GLint linked;

	snprintf(head, sizeof(head), "#version 120\n#define LIGHTS %d\n#define VIEWER %s\n",
		 lights(scene), scene->local_viewer ? "normalize(-at)" : "vec3(0.0, 0.0, 1.0)");
	attach(program, GL_VERTEX_SHADER, "", vertex_shader);
	attach(program, GL_FRAGMENT_SHADER, head, fragment_shader);
	glBindAttribLocation(program, 0, "position");
	glBindAttribLocation(program, 1, "normal");
	glLinkProgram(program);
	glGetProgramiv(program, GL_LINK_STATUS, &linked);
	if (linked)
		return program;
	glDeleteProgram(program);
	return 0;
}

static void product(float out[3], const float a[3], const float b[3])
{
	for (int i = 0; i < 3; i++)
		out[i] = a[i] * b[i];
}

static void set_vector(GLuint program, const char *name, int index, const float v[3])
{
	char element[32];

	snprintf(element, sizeof(element), "%s[%d]", name, index);
	glUniform3fv(glGetUniformLocation(program, element), 1, v);
}

/* Adds to @base what the light gives everywhere. */
static void set_program_light(GLuint program, int index, const struct accel_light *light,
			      const struct accel_material *material, float base[4])
{
	float length = hypotf(hypotf(light->position[0], light->position[1]), light->position[2]);
	float toward[3], part[3];

	for (int i = 0; i < 3; i++)
		toward[i] = light->position[i] / length;
	set_vector(program, "toward", index, toward);
	product(part, light->diffuse, material->diffuse);
	set_vector(program, "diffuse", index, part);
	product(part, light->specular, material->specular);
	set_vector(program, "specular", index, part);
	product(part, light->ambient, material->ambient);
	for (int i = 0; i < 3; i++)
		base[i] += part[i];
}

static void set_matrices(GLuint program, const struct scene *scene)
{
	float turn[9];

	matrix_normal(turn, scene->modelview);
	glUniformMatrix4fv(glGetUniformLocation(program, "modelview"), 1, GL_FALSE,
			   scene->modelview);
	glUniformMatrix4fv(glGetUniformLocation(program, "projection"), 1, GL_FALSE,
			   scene->projection);
	glUniformMatrix3fv(glGetUniformLocation(program, "turn"), 1, GL_FALSE, turn);
}

void gl_scene_set_program(GLuint program, const struct scene *scene)
{
	const struct accel_material *material = &scene->material[0];
	float base[4] = { [3] = material->diffuse[3] };
	int index = 0;

	glUseProgram(program);
	set_matrices(program, scene);
	product(base, scene->ambient, material->ambient);
	for (int i = 0; i < 3; i++)
		base[i] += material->emission[i];
	for (int i = 0; i < ACCEL_LIGHTS; i++)
		if (scene->light[i].enabled)
			set_program_light(program, index++, &scene->light[i], material, base);
	glUniform4fv(glGetUniformLocation(program, "base"), 1, base);
	glUniform1f(glGetUniformLocation(program, "exponent"), material->shininess);
}
