// SPDX-License-Identifier: MIT
/*
 * bench_load
 *
 * What it takes to read an STL file of a million triangles, to join its vertices and to make
 * normals with creases, against what assimp alone takes to read it and make normals of its own
 * (which it does not join), and against reading alone. Processor time, and the most memory of
 * one process, each in processes of their own that take turns; the least of each counts. Lines
 * "name value" are for make bench.
 */
#include <assimp/cimport.h>
#include <assimp/postprocess.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "scene/mesh.h"

#define ROUNDS 3
#define WIDTH 500 /* of a torus of 4 * WIDTH * WIDTH triangles */

struct cost {
	double seconds, megabytes;
};

static void die(const char *what)
{
	fprintf(stderr, "bench_load: %s\n", what);
	exit(1);
}

static void write_triangle(FILE *file, const struct mesh *mesh, const uint32_t index[3])
{
	static const float normal[3];
	static const uint16_t attribute;

	fwrite(normal, sizeof(normal), 1, file);
	for (int i = 0; i < 3; i++)
		fwrite(mesh->position[index[i]], sizeof(*mesh->position), 1, file);
	fwrite(&attribute, sizeof(attribute), 1, file);
}

static void write_stl(const char *path)
{
	static const char header[80] = "a torus";
	FILE *file = fopen(path, "wb");
	struct mesh mesh;

	if (!file || mesh_torus(WIDTH, &mesh))
		die("can not make the file");
	fwrite(header, sizeof(header), 1, file);
	fwrite(&mesh.triangles, sizeof(mesh.triangles), 1, file);
	for (uint32_t i = 0; i < mesh.triangles; i++)
		write_triangle(file, &mesh, mesh.triangle[i]);
	if (fclose(file))
		die("can not write the file");
	mesh_free(&mesh);
}

static void import(const char *path, unsigned int steps)
{
	const struct aiScene *scene = aiImportFile(path, steps);

	if (!scene)
		_exit(1);
	aiReleaseImport(scene);
}

static void read_alone(const char *path)
{
	import(path, aiProcess_Triangulate);
}

static void load_alone(const char *path)
{
	import(path,
	       aiProcess_Triangulate | aiProcess_ForceGenNormals | aiProcess_GenSmoothNormals);
}

static void load_mesh(const char *path)
{
	static const struct mesh_options options = { .crease = MESH_CREASE };
	char message[MESH_MESSAGE];
	struct mesh mesh;

	if (mesh_load(path, &options, &mesh, message))
		_exit(1);
	mesh_free(&mesh);
}

static void measure(void (*load)(const char *path), const char *path, struct cost *least)
{
	struct rusage usage;
	double seconds;
	int status;
	pid_t pid = fork();

	if (!pid) {
		load(path);
		_exit(0);
	}
	/* What the process has waited for counts with it. */
	if (wait4(pid, &status, 0, &usage) != pid || status)
		die("can not read the file");
	seconds = (double)(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
		  (double)(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec) * 1e-6;
	least->seconds = fmin(least->seconds, seconds);
	least->megabytes = fmin(least->megabytes, (double)usage.ru_maxrss / 1024);
}

int main(void)
{
	struct cost alone = { INFINITY, INFINITY }, mesh = alone, reading = alone;
	char path[] = "/tmp/bench-load-XXXXXX.stl";

	if (mkstemps(path, 4) < 0)
		die("can not make a file");
	write_stl(path);
	for (int i = 0; i < ROUNDS; i++) {
		measure(read_alone, path, &reading);
		measure(load_alone, path, &alone);
		measure(load_mesh, path, &mesh);
	}
	unlink(path);
	printf("# %d triangles of STL: assimp's reading %.2f s, %.0f MB; with its normals %.2f s, "
	       "%.0f MB; as a mesh %.2f s, %.0f MB\n",
	       4 * WIDTH * WIDTH, reading.seconds, reading.megabytes, alone.seconds,
	       alone.megabytes, mesh.seconds, mesh.megabytes);
	printf("load.time.vs_assimp %.2f\nload.memory.vs_assimp %.2f\n",
	       mesh.seconds / alone.seconds, mesh.megabytes / alone.megabytes);
	printf("load.time.vs_reading %.2f\nload.memory.vs_reading %.2f\n",
	       mesh.seconds / reading.seconds, mesh.megabytes / reading.megabytes);
	return 0;
}
