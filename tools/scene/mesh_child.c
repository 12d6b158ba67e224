// SPDX-License-Identifier: MIT
#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "scene/mesh_child.h"

/* The libraries alone take hundreds of megabytes of addresses. */
#define MEMORY_MIN (UINT64_C(1) << 30)
#define MEMORY_MAX (UINT64_C(16) << 30)
#define SECONDS_MAX 600
#define WAIT_MS 100

/* The beginning of the memory both processes see; the mesh's arrays follow it. */
struct report {
	int error;
	bool complete;			/* the child came to its end */
	bool coloured;
	uint32_t vertices, triangles;
	char message[MESH_MESSAGE];
};

struct child {
	pid_t pid;
	int memory;			/* file descriptor of a struct report and arrays */
	int alive;			/* a pipe that ends with the child */
	struct report *report;
};

static int out_of_memory(const char *path, char message[MESH_MESSAGE])
{
	snprintf(message, MESH_MESSAGE, "out of memory: %s: give a smaller mesh", path);
	return -ENOMEM;
}

struct child_limits child_limits_default(void)
{
	uint64_t half = (uint64_t)sysconf(_SC_PHYS_PAGES) / 2 * (uint64_t)sysconf(_SC_PAGESIZE);

	return (struct child_limits){
		.memory = half < MEMORY_MIN ? MEMORY_MIN : half < MEMORY_MAX ? half : MEMORY_MAX,
		.seconds = SECONDS_MAX,
	};
}

/* ---- the child's side ---- */

static void limit(int resource, uint64_t soft, uint64_t hard)
{
	struct rlimit now, wanted;

	if (getrlimit(resource, &now))
		return;
	/* What is lower already stays so. */
	wanted.rlim_max = now.rlim_max < hard ? now.rlim_max : hard;
	wanted.rlim_cur = now.rlim_cur < soft ? now.rlim_cur : soft;
	setrlimit(resource, &wanted);
}

static void confine(const struct child_limits *limits, pid_t parent)
{
	int null = open("/dev/null", O_RDWR | O_CLOEXEC);

	for (int fd = 0; fd < 3 && null >= 0; fd++)
		dup2(null, fd);
	signal(SIGINT, SIG_DFL);
	signal(SIGTERM, SIG_DFL);
	prctl(PR_SET_PDEATHSIG, SIGKILL);
	if (getppid() != parent)
		_exit(1);
	limit(RLIMIT_CORE, 0, 0);
	limit(RLIMIT_CPU, limits->seconds, (uint64_t)limits->seconds + 1);
	/* The sanitizer has all addresses there are. */
#ifndef __SANITIZE_ADDRESS__
	limit(RLIMIT_AS, limits->memory, limits->memory);
#endif
}

static size_t place_arrays(const struct report *report, struct mesh *mesh)
{
	char *at = (char *)(report + 1);
	const char *begin = (const char *)report;

	*mesh = (struct mesh){ .vertices = report->vertices, .triangles = report->triangles };
	mesh->position = (void *)at;
	at += sizeof(*mesh->position) * mesh->vertices;
	mesh->normal = (void *)at;
	at += sizeof(*mesh->normal) * mesh->vertices;
	if (report->coloured) {
		mesh->colour = (void *)at;
		at += sizeof(*mesh->colour) * mesh->vertices;
	}
	mesh->triangle = (void *)at;
	at += sizeof(*mesh->triangle) * mesh->triangles;
	return at - begin;
}

static void copy_arrays(const struct mesh *to, const struct mesh *from)
{
	memcpy(to->position, from->position, sizeof(*to->position) * to->vertices);
	memcpy(to->normal, from->normal, sizeof(*to->normal) * to->vertices);
	if (to->colour && from->colour)
		memcpy(to->colour, from->colour, sizeof(*to->colour) * to->vertices);
	memcpy(to->triangle, from->triangle, sizeof(*to->triangle) * to->triangles);
}

/* Puts the mesh behind the report. */
static int hand_over(const struct child *child, const struct mesh *mesh)
{
	struct report *report = child->report;
	struct mesh shared;
	size_t size;
	void *map;

	report->vertices = mesh->vertices;
	report->triangles = mesh->triangles;
	report->coloured = mesh->colour != NULL;
	size = place_arrays(report, &shared);
	if (posix_fallocate(child->memory, 0, (off_t)size))
		return -ENOMEM;
	map = mmap(NULL, size, PROT_READ | PROT_WRITE, MAP_SHARED, child->memory, 0);
	if (map == MAP_FAILED)
		return -ENOMEM;
	place_arrays(map, &shared);
	copy_arrays(&shared, mesh);
	return 0;
}

static void work(const struct child *child, child_fn load, const char *path,
		 const struct mesh_options *options)
{
	struct report *report = child->report;
	struct mesh mesh = { 0 };

	report->error = load(path, options, &mesh, report->message);
	if (!report->error && hand_over(child, &mesh))
		report->error = out_of_memory(path, report->message);
	report->complete = true;
	_exit(0);
}

/* ---- the parent's side ---- */

static int start(struct child *child)
{
	child->memory = memfd_create("mesh", MFD_CLOEXEC);
	if (child->memory < 0 || ftruncate(child->memory, sizeof(*child->report)))
		return -ENOMEM;
	child->report = mmap(NULL, sizeof(*child->report), PROT_READ | PROT_WRITE, MAP_SHARED,
			     child->memory, 0);
	return child->report == MAP_FAILED ? -ENOMEM : 0;
}

static void finish(struct child *child)
{
	if (child->report && child->report != MAP_FAILED)
		munmap(child->report, sizeof(*child->report));
	if (child->memory >= 0)
		close(child->memory);
}

static int wait_for(struct child *child, const struct mesh_options *options)
{
	struct pollfd end = { .fd = child->alive, .events = POLLIN };
	int status = 0;

	while (poll(&end, 1, WAIT_MS) <= 0)
		if (options->waiting)
			options->waiting(options->data);
	while (waitpid(child->pid, &status, 0) < 0 && errno == EINTR)
		;
	return status;
}

static int crashed(const char *path, int status, const struct child_limits *limits,
		   char message[MESH_MESSAGE])
{
	int number = WIFSIGNALED(status) ? WTERMSIG(status) : 0;

	if (number == SIGXCPU) {
		snprintf(message, MESH_MESSAGE, "mesh takes too long: %s: reading it is given up "
			 "after %u seconds; repair or convert the file", path, limits->seconds);
		return -ETIME;
	}
	if (number == SIGKILL) {
		snprintf(message, MESH_MESSAGE, "can not read mesh: %s: its reader was killed, for "
			 "want of memory it may be; give a smaller mesh", path);
		return -ENOMEM;
	}
	snprintf(message, MESH_MESSAGE, "can not read mesh: %s: assimp crashed on it (%s); "
		 "repair or convert the file", path, number ? strsignal(number) : "it left");
	return -EPROTO;
}

static bool has_vertices(const struct mesh *mesh)
{
	for (uint32_t i = 0; i < mesh->triangles; i++)
		for (int j = 0; j < 3; j++)
			if (mesh->triangle[i][j] >= mesh->vertices)
				return false;
	return true;
}

/* The child's numbers are as little to be trusted as the file. */
static int take(const struct child *child, const char *path, struct mesh *mesh,
		char message[MESH_MESSAGE])
{
	off_t end = lseek(child->memory, 0, SEEK_END);
	struct mesh shared;
	int ret = 0;
	void *map;

	if (end < (off_t)place_arrays(child->report, &shared))
		return crashed(path, 0, NULL, message);
	map = mmap(NULL, end, PROT_READ, MAP_SHARED, child->memory, 0);
	if (map == MAP_FAILED)
		return out_of_memory(path, message);
	place_arrays(map, &shared);
	if (mesh_new(shared.vertices, shared.triangles, mesh))
		ret = out_of_memory(path, message);
	if (!ret && shared.colour) {
		mesh->colour = calloc(shared.vertices, sizeof(*mesh->colour));
		ret = mesh->colour ? 0 : out_of_memory(path, message);
	}
	if (!ret)
		copy_arrays(mesh, &shared);
	if (!ret && !has_vertices(mesh))
		ret = crashed(path, 0, NULL, message);
	if (ret)
		mesh_free(mesh);
	munmap(map, end);
	return ret;
}

static int collect(const struct child *child, int status, const char *path,
		   const struct child_limits *limits, struct mesh *mesh,
		   char message[MESH_MESSAGE])
{
	const struct report *report = child->report;

	if (!WIFEXITED(status) || !report->complete)
		return crashed(path, status, limits, message);
	if (!report->error)
		return take(child, path, mesh, message);
	snprintf(message, MESH_MESSAGE, "%.*s", MESH_MESSAGE - 1, report->message);
	return report->error;
}

int child_run(child_fn load, const char *path, const struct mesh_options *options,
	      const struct child_limits *limits, struct mesh *mesh, char message[MESH_MESSAGE])
{
	struct child child = { 0 };
	int pipe[2], ret = start(&child);
	pid_t parent = getpid();

	if (ret || pipe2(pipe, O_CLOEXEC)) {
		finish(&child);
		return out_of_memory(path, message);
	}
	child.pid = fork();
	if (!child.pid) {
		confine(limits, parent);
		work(&child, load, path, options);
	}
	close(pipe[1]);
	child.alive = pipe[0];
	if (child.pid < 0)
		ret = out_of_memory(path, message);
	else
		ret = collect(&child, wait_for(&child, options), path, limits, mesh, message);
	close(pipe[0]);
	finish(&child);
	return ret;
}
