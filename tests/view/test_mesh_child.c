// SPDX-License-Identifier: MIT
/* What a reader of files may do wrong, in its process; here it is functions that do it. */
#include <errno.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

#include "scene/mesh_child.h"

static const struct mesh_options options = { .crease = MESH_CREASE };
static struct child_limits limits;

static int run(child_fn load, struct mesh *mesh, char message[MESH_MESSAGE])
{
	int ret = child_run(load, "a/b.obj", &options, &limits, mesh, message);

	if (ret)
		assert_null(strchr(message, '\n'));
	/* No child is left, not even a dead one. */
	assert_int_equal(waitpid(-1, NULL, WNOHANG), -1);
	assert_int_equal(errno, ECHILD);
	return ret;
}

static int load_torus(const char *path, const struct mesh_options *given, struct mesh *mesh,
		      char message[MESH_MESSAGE])
{
	(void)message;
	if (strcmp(path, "a/b.obj") != 0 || given->crease != options.crease)
		return -EINVAL;
	puts("not to be seen");
	fflush(stdout);
	return mesh_torus(30, mesh);
}

static int load_coloured(const char *path, const struct mesh_options *given, struct mesh *mesh,
			 char message[MESH_MESSAGE])
{
	int ret = load_torus(path, given, mesh, message);

	mesh->colour = calloc(mesh->vertices, sizeof(*mesh->colour));
	for (uint32_t i = 0; i < mesh->vertices; i++)
		mesh->colour[i][i % 4] = (float)i;
	return ret;
}

static void what_the_child_made_arrives(void **state)
{
	char message[MESH_MESSAGE];
	struct mesh torus, mesh;

	(void)state;
	assert_int_equal(mesh_torus(30, &torus), 0);
	assert_int_equal(run(load_torus, &mesh, message), 0);
	assert_int_equal(mesh.vertices, torus.vertices);
	assert_int_equal(mesh.triangles, torus.triangles);
	assert_memory_equal(mesh.position, torus.position, sizeof(float[3]) * torus.vertices);
	assert_memory_equal(mesh.normal, torus.normal, sizeof(float[3]) * torus.vertices);
	assert_memory_equal(mesh.triangle, torus.triangle, sizeof(uint32_t[3]) * torus.triangles);
	assert_null(mesh.colour);
	mesh_free(&mesh);
	assert_int_equal(run(load_coloured, &mesh, message), 0);
	assert_memory_equal(mesh.triangle, torus.triangle, sizeof(uint32_t[3]) * torus.triangles);
	for (uint32_t i = 0; i < mesh.vertices; i++)
		assert_true(mesh.colour[i][i % 4] == (float)i);
	mesh_free(&mesh);
	mesh_free(&torus);
}

static int load_refused(const char *path, const struct mesh_options *given, struct mesh *mesh,
			char message[MESH_MESSAGE])
{
	(void)given;
	(void)mesh;
	snprintf(message, MESH_MESSAGE, "no good: %s: try another", path);
	return -EDOM;
}

static void its_error_and_message_arrive(void **state)
{
	char message[MESH_MESSAGE];
	struct mesh mesh;

	(void)state;
	assert_int_equal(run(load_refused, &mesh, message), -EDOM);
	assert_string_equal(message, "no good: a/b.obj: try another");
}

static int load_crashing(const char *path, const struct mesh_options *given, struct mesh *mesh,
			 char message[MESH_MESSAGE])
{
	(void)path;
	(void)given;
	(void)mesh;
	(void)message;
	/* As of the kernel: the sanitizer's handler would exit instead. */
	signal(SIGSEGV, SIG_DFL);
	raise(SIGSEGV);
	return 0;
}

static int load_aborting(const char *path, const struct mesh_options *given, struct mesh *mesh,
			 char message[MESH_MESSAGE])
{
	(void)path;
	(void)given;
	(void)mesh;
	(void)message;
	fputs("terminate called after throwing an instance\n", stderr);
	abort();
}

static int load_leaving(const char *path, const struct mesh_options *given, struct mesh *mesh,
			char message[MESH_MESSAGE])
{
	(void)path;
	(void)given;
	(void)mesh;
	(void)message;
	_exit(0);
}

static int load_spoilt(const char *path, const struct mesh_options *given, struct mesh *mesh,
		       char message[MESH_MESSAGE])
{
	int ret = load_torus(path, given, mesh, message);

	mesh->triangle[mesh->triangles - 1][2] = mesh->vertices;
	return ret;
}

static void an_index_without_a_vertex_does_not_arrive(void **state)
{
	struct mesh mesh = { 0 };
	char message[MESH_MESSAGE];

	(void)state;
	assert_int_equal(run(load_spoilt, &mesh, message), -EPROTO);
	assert_non_null(strstr(message, "a/b.obj"));
	assert_null(mesh.triangle);
}

static void a_crash_is_an_error_and_a_line(void **state)
{
	char message[MESH_MESSAGE];
	struct mesh mesh;

	(void)state;
	assert_int_equal(run(load_crashing, &mesh, message), -EPROTO);
	assert_string_equal(message, "can not read mesh: a/b.obj: assimp crashed on it "
				     "(Segmentation fault); repair or convert the file");
	assert_int_equal(run(load_aborting, &mesh, message), -EPROTO);
	assert_int_equal(run(load_leaving, &mesh, message), -EPROTO);
	assert_non_null(strstr(message, "can not read mesh: a/b.obj: "));
}

static int load_endless(const char *path, const struct mesh_options *given, struct mesh *mesh,
			char message[MESH_MESSAGE])
{
	volatile bool more = true;

	(void)path;
	(void)given;
	(void)mesh;
	(void)message;
	while (more)
		;
	return 0;
}

static void what_never_ends_is_ended(void **state)
{
	struct child_limits before = limits;
	char message[MESH_MESSAGE];
	struct mesh mesh;

	(void)state;
	limits.seconds = 1;
	assert_int_equal(run(load_endless, &mesh, message), -ETIME);
	assert_non_null(strstr(message, "mesh takes too long: a/b.obj: "));
	limits = before;
}

/* Tells by its error how much it got: the limit is 1 GiB. */
static int load_greedy(const char *path, const struct mesh_options *given, struct mesh *mesh,
		       char message[MESH_MESSAGE])
{
	static void *block[64];
	struct rlimit core;

	(void)path;
	(void)given;
	(void)mesh;
	(void)message;
	if (getrlimit(RLIMIT_CORE, &core) || core.rlim_max)
		return -EINVAL;
	for (int i = 0; i < 64; i++) {
		block[i] = malloc(1 << 26);
		if (!block[i])
			return i < 16 ? -ENOMEM : -ERANGE;
	}
	return -E2BIG;
}

static void memory_has_an_end(void **state)
{
	struct child_limits before = limits;
	char message[MESH_MESSAGE];
	struct mesh mesh;

	(void)state;
#ifdef __SANITIZE_ADDRESS__
	skip();
#endif
	limits.memory = 1 << 30;
	assert_int_equal(run(load_greedy, &mesh, message), -ENOMEM);
	limits = before;
}

static int load_killed(const char *path, const struct mesh_options *given, struct mesh *mesh,
		       char message[MESH_MESSAGE])
{
	(void)path;
	(void)given;
	(void)mesh;
	(void)message;
	raise(SIGKILL);
	return 0;
}

static void who_is_killed_may_have_wanted_memory(void **state)
{
	char message[MESH_MESSAGE];
	struct mesh mesh;

	(void)state;
	assert_int_equal(run(load_killed, &mesh, message), -ENOMEM);
}

/* Tells the child that it has waited. */
static void tell(void *data)
{
	const int *pipe = data;

	assert_int_equal(write(pipe[1], "", 1), 1);
}

/* Until the one who waits has told so. */
static int load_when_told(const char *path, const struct mesh_options *given, struct mesh *mesh,
			  char message[MESH_MESSAGE])
{
	const int *pipe = given->data;
	char byte;

	(void)path;
	(void)message;
	return read(pipe[0], &byte, 1) == 1 ? mesh_cube(mesh) : -EIO;
}

static void who_waits_is_told(void **state)
{
	int ends[2];
	const struct mesh_options told = { .waiting = tell, .data = ends };
	char message[MESH_MESSAGE];
	struct mesh mesh;

	(void)state;
	assert_int_equal(pipe(ends), 0);
	assert_int_equal(child_run(load_when_told, "m", &told, &limits, &mesh, message), 0);
	mesh_free(&mesh);
	close(ends[0]);
	close(ends[1]);
}

/* Who waits for the reader is killed: the reader goes too, and orphans come to this process. */
static void nothing_is_left_of_a_killed_caller(void **state)
{
	char message[MESH_MESSAGE];
	struct mesh mesh;
	int status;
	pid_t pid;

	(void)state;
	assert_int_equal(prctl(PR_SET_CHILD_SUBREAPER, 1), 0);
	pid = fork();
	if (!pid) {
		child_run(load_endless, "m", &options, &limits, &mesh, message);
		_exit(0);
	}
	usleep(200000);
	kill(pid, SIGKILL);
	assert_int_equal(waitpid(pid, &status, 0), pid);
	/* The reader, killed in its turn, unless it was not there yet. */
	if (waitpid(-1, &status, 0) > 0)
		assert_true(WIFSIGNALED(status) || WEXITSTATUS(status) == 1);
	assert_int_equal(prctl(PR_SET_CHILD_SUBREAPER, 0), 0);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(what_the_child_made_arrives),
		cmocka_unit_test(its_error_and_message_arrive),
		cmocka_unit_test(an_index_without_a_vertex_does_not_arrive),
		cmocka_unit_test(a_crash_is_an_error_and_a_line),
		cmocka_unit_test(what_never_ends_is_ended),
		cmocka_unit_test(memory_has_an_end),
		cmocka_unit_test(who_is_killed_may_have_wanted_memory),
		cmocka_unit_test(who_waits_is_told),
		cmocka_unit_test(nothing_is_left_of_a_killed_caller),
	};

	limits = child_limits_default();
	return cmocka_run_group_tests(tests, NULL, NULL);
}
