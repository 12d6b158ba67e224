// SPDX-License-Identifier: MIT
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <malloc.h>
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
	bool complete; /* the child came to its end */
	bool coloured;
	uint32_t vertices, triangles;
	char message[MESH_MESSAGE];
};

struct child {
	pid_t pid;
	int memory; /* file descriptor of a struct report and arrays */
	int alive;  /* a pipe that ends with the child */
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
		.memory = half < MEMORY_MIN ? MEMORY_MIN :
			  half < MEMORY_MAX ? half :
					      MEMORY_MAX,
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
	/*
	 * Memory comes from the heap alone, and what is freed of it, like the text of the file, is
	 * used again: new pages are what takes the time.
	 */
	mallopt(M_MMAP_MAX, 0);
	mallopt(M_TRIM_THRESHOLD, INT_MAX);
	limit(RLIMIT_CORE, 0, 0);
	limit(RLIMIT_CPU, limits->seconds, (uint64_t)limits->seconds + 1);
	/* The sanitizer has all addresses there are. */
#ifndef __SANITIZE_ADDRESS__
	limit(RLIMIT_AS, limits->memory, limits->memory);
#endif
}

static int write_all(int fd, const void *data, size_t size)
{
	const char *at = data;

	while (size) {
		ssize_t written = write(fd, at, size);

		if (written < 0 && errno != EINTR)
			return -ENOMEM;
		at += written > 0 ? written : 0;
		size -= written > 0 ? (size_t)written : 0;
	}
	return 0;
}

/* Puts the mesh behind the report, in the order of place_arrays. */
static int hand_over(const struct child *child, const struct mesh *mesh)
{
	struct report *report = child->report;
	int fd = child->memory;

	report->vertices = mesh->vertices;
	report->triangles = mesh->triangles;
	report->coloured = mesh->colour != NULL;
	if (lseek(fd, sizeof(*report), SEEK_SET) < 0 ||
	    write_all(fd, mesh->position, sizeof(*mesh->position) * mesh->vertices) ||
	    write_all(fd, mesh->normal, sizeof(*mesh->normal) * mesh->vertices) ||
	    (mesh->colour && write_all(fd, mesh->colour, sizeof(*mesh->colour) * mesh->vertices)))
		return -ENOMEM;
	return write_all(fd, mesh->triangle, sizeof(*mesh->triangle) * mesh->triangles);
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
	child->memory = memfd_create("mesh", MFD_CLOEXEC | MFD_ALLOW_SEALING);
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
		snprintf(message, MESH_MESSAGE,
			 "mesh takes too long: %s: reading it is given up "
			 "after %u seconds; repair or convert the file",
			 path, limits->seconds);
		return -ETIME;
	}
	if (number == SIGKILL) {
		snprintf(message, MESH_MESSAGE,
			 "can not read mesh: %s: its reader was killed, for "
			 "want of memory it may be; give a smaller mesh",
			 path);
		return -ENOMEM;
	}
	snprintf(message, MESH_MESSAGE,
		 "can not read mesh: %s: assimp crashed on it (%s); "
		 "repair or convert the file",
		 path, number ? strsignal(number) : "it left");
	return -EPROTO;
}

/* The arrays of a mesh behind its report; returns how far they reach. */
static size_t place_arrays(const struct report *report, char *map, struct mesh *mesh)
{
	char *at = map + sizeof(*report);

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
	return at - map;
}

static bool has_vertices(const struct mesh *mesh)
{
	for (uint32_t i = 0; i < mesh->triangles; i++)
		for (int j = 0; j < 3; j++)
			if (mesh->triangle[i][j] >= mesh->vertices)
				return false;
	return true;
}

/*
 * The child's numbers are as little to be trusted as the file. The memory is lent to the mesh as
 * it is, sealed, so that nothing the child may have left can change what has been checked.
 */
static int take(const struct child *child, const struct report *report, const char *path,
		struct mesh *mesh, char message[MESH_MESSAGE])
{
	const int seals = F_SEAL_WRITE | F_SEAL_SHRINK | F_SEAL_GROW;
	off_t end = lseek(child->memory, 0, SEEK_END);
	void *map;

	if (fcntl(child->memory, F_ADD_SEALS, seals) || end < (off_t)sizeof(*report))
		return crashed(path, 0, NULL, message);
	map = mmap(NULL, end, PROT_READ | PROT_WRITE, MAP_PRIVATE, child->memory, 0);
	if (map == MAP_FAILED)
		return out_of_memory(path, message);
	if (end < (off_t)place_arrays(report, map, mesh) || !has_vertices(mesh)) {
		munmap(map, end);
		memset(mesh, 0, sizeof(*mesh));
		return crashed(path, 0, NULL, message);
	}
	mesh->map = map;
	mesh->map_size = end;
	return 0;
}

static int collect(struct child *child, int status, const char *path,
		   const struct child_limits *limits, struct mesh *mesh, char message[MESH_MESSAGE])
{
	const struct report report = *child->report;

	munmap(child->report, sizeof(*child->report));
	child->report = NULL;
	if (!WIFEXITED(status) || !report.complete)
		return crashed(path, status, limits, message);
	if (!report.error)
		return take(child, &report, path, mesh, message);
	snprintf(message, MESH_MESSAGE, "%.*s", MESH_MESSAGE - 1, report.message);
	return report.error;
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
