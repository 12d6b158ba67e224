// SPDX-License-Identifier: MIT
/*
 * For LD_PRELOAD, with Mesa below: a program's lights shine on each pixel instead of each vertex, as Phong's
 * shading has it. A shader takes the program's own matrices, lights and materials; it is put in at the first
 * glClear. Lights and the position of the eye are looked up there, spots and two sides are not known.
 */
#include <GL/gl.h>
#include <GL/glext.h>
#include <GL/glx.h>
#include <dlfcn.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>

/* The normal goes down as a colour, which alone glShadeModel makes flat. It is halved: colours are clamped. */
static const char vertex_text[] = "#version 120\n"
				  "varying vec3 eye;\n"
				  "void main() {\n"
				  "	eye = vec3(gl_ModelViewMatrix * gl_Vertex);\n"
				  "	vec3 normal = normalize(gl_NormalMatrix * gl_Normal);\n"
				  "	gl_FrontColor = vec4(normal * 0.5 + 0.5, 1.0);\n"
				  "	gl_Position = ftransform();\n"
				  "}\n";

static const char fragment_text[] =
	"#version 120\n"
	"varying vec3 eye;\n"
	"uniform bool shines[8], local_viewer;\n"
	"void main() {\n"
	"	vec3 n = normalize(gl_Color.rgb * 2.0 - 1.0);\n"
	"	vec3 v = local_viewer ? normalize(-eye) : vec3(0.0, 0.0, 1.0);\n"
	"	vec3 sum = gl_FrontLightModelProduct.sceneColor.rgb;\n"
	"	for (int i = 0; i < 8; i++) {\n"
	"		if (!shines[i])\n"
	"			continue;\n"
	"		vec4 p = gl_LightSource[i].position;\n"
	"		vec3 to = p.w == 0.0 ? p.xyz : p.xyz / p.w - eye;\n"
	"		float d = length(to), fading = 1.0;\n"
	"		vec3 l = to / d, h = normalize(l + v);\n"
	"		if (p.w != 0.0)\n"
	"			fading = 1.0 / (gl_LightSource[i].constantAttenuation +\n"
	"				d * gl_LightSource[i].linearAttenuation +\n"
	"				d * d * gl_LightSource[i].quadraticAttenuation);\n"
	"		vec3 light = gl_FrontLightProduct[i].ambient.rgb;\n"
	"		if (dot(n, l) > 0.0)\n"
	"			light += gl_FrontLightProduct[i].diffuse.rgb * dot(n, l) +\n"
	"				gl_FrontLightProduct[i].specular.rgb *\n"
	"				pow(max(dot(n, h), 1e-9), gl_FrontMaterial.shininess);\n"
	"		sum += fading * light;\n"
	"	}\n"
	"	gl_FragColor = vec4(sum, 1.0);\n"
	"}\n";

/* A function of OpenGL 2.0, with the type that glext.h has for it. */
#define CALL(type, name) ((type)glXGetProcAddressARB((const GLubyte *)(name)))

static void compile(GLuint program, GLenum kind, const char *text)
{
	GLuint shader = CALL(PFNGLCREATESHADERPROC, "glCreateShader")(kind);

	CALL(PFNGLSHADERSOURCEPROC, "glShaderSource")(shader, 1, &text, NULL);
	CALL(PFNGLCOMPILESHADERPROC, "glCompileShader")(shader);
	CALL(PFNGLATTACHSHADERPROC, "glAttachShader")(program, shader);
}

static void take_lights(GLuint program)
{
	PFNGLGETUNIFORMLOCATIONPROC where = CALL(PFNGLGETUNIFORMLOCATIONPROC,
						 "glGetUniformLocation");
	PFNGLUNIFORM1IVPROC set = CALL(PFNGLUNIFORM1IVPROC, "glUniform1iv");
	GLint shines[8], local_viewer;

	for (unsigned int i = 0; i < 8; i++)
		shines[i] = glIsEnabled(GL_LIGHT0 + i);
	glGetIntegerv(GL_LIGHT_MODEL_LOCAL_VIEWER, &local_viewer);
	set(where(program, "shines"), 8, shines);
	set(where(program, "local_viewer"), 1, &local_viewer);
}

static void shade_pixels(void)
{
	GLuint program = CALL(PFNGLCREATEPROGRAMPROC, "glCreateProgram")();
	GLint linked;

	compile(program, GL_VERTEX_SHADER, vertex_text);
	compile(program, GL_FRAGMENT_SHADER, fragment_text);
	CALL(PFNGLLINKPROGRAMPROC, "glLinkProgram")(program);
	CALL(PFNGLGETPROGRAMIVPROC, "glGetProgramiv")(program, GL_LINK_STATUS, &linked);
	if (!linked) {
		fprintf(stderr, "pixel_light: the shader does not link on this OpenGL\n");
		exit(1);
	}
	CALL(PFNGLUSEPROGRAMPROC, "glUseProgram")(program);
	take_lights(program);
}

void glClear(GLbitfield buffers)
{
	static void (*clear)(GLbitfield);

	if (!clear) {
		*(void **)&clear = dlsym(RTLD_NEXT, "glClear");
		shade_pixels();
	}
	clear(buffers);
}
