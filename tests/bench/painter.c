// SPDX-License-Identifier: MIT
/* The processes of painters, and how they are asked: a message each way for each frame. */
#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "painter.h"

struct request {
	struct scene scene;
	bool read;
};

struct answer {
	int error;
	struct painter_cost cost;
	char message[PAINTER_MESSAGE]; /* of the first: who draws, or what is missing */
};

static double seconds(clockid_t clock)
{
	struct timespec time;

	clock_gettime(clock, &time);
	return (double)time.tv_sec + (double)time.tv_nsec * 1e-9;
}

/* ---- in the painter's process ---- */

static struct answer draw(const struct way *way, void *state, const struct scene *scene)
{
	double processor = seconds(CLOCK_PROCESS_CPUTIME_ID), wall = seconds(CLOCK_MONOTONIC);
	struct answer answer = { .error = way->ops->draw(state, scene) };

	answer.cost.processor = seconds(CLOCK_PROCESS_CPUTIME_ID) - processor;
	answer.cost.wall = seconds(CLOCK_MONOTONIC) - wall;
	return answer;
}

static void paint(const struct painter *painter, const struct scene *scene)
{
	const struct way *way = painter->way;
	struct answer answer = { 0 };
	struct request request;
	void *state = way->ops->open(way, scene, answer.message);

	answer.error = state ? 0 : -ENODEV;
	send(painter->link, &answer, sizeof(answer), MSG_NOSIGNAL);
	while (state && recv(painter->link, &request, sizeof(request), 0) == sizeof(request)) {
		answer = draw(way, state, &request.scene);
		if (!answer.error && request.read)
			answer.error = way->ops->read(state, painter->colour, painter->depth);
		send(painter->link, &answer, sizeof(answer), MSG_NOSIGNAL);
	}
}

/* ---- in the program's ---- */

static int hear(const struct painter *painter, struct answer *answer)
{
	ssize_t length = recv(painter->link, answer, sizeof(*answer), 0);

	return length == sizeof(*answer) ? answer->error : -EPIPE;
}

static int ask(struct painter *painter, const struct request *request, struct answer *answer)
{
	if (send(painter->link, request, sizeof(*request), MSG_NOSIGNAL) != sizeof(*request))
		return -EPIPE;
	return hear(painter, answer);
}

static int begin(struct painter *painter, const struct scene *scene)
{
	const char *name = painter->way->name;
	int ends[2];

	if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends))
		return -errno;
	/* What is buffered would be printed by both. */
	fflush(NULL);
	painter->process = fork();
	if (!painter->process) {
		prctl(PR_SET_PDEATHSIG, SIGKILL);
		prctl(PR_SET_NAME, name); /* for profiles: perf report --comm */
		close(ends[0]);
		painter->link = ends[1];
		paint(painter, scene);
		_exit(0);
	}
	close(ends[1]);
	painter->link = ends[0];
	return painter->process < 0 ? -errno : 0;
}

int painter_start(struct painter *painter, const struct way *way, const struct scene *scene,
		  char message[PAINTER_MESSAGE])
{
	size_t pixels = (size_t)scene->width * scene->height;
	struct answer answer = { 0 };
	int ret;

	*painter = (struct painter){ .way = way, .pixels = pixels };
	painter->colour = mmap(NULL, pixels * 2 * sizeof(uint32_t), PROT_READ | PROT_WRITE,
			       MAP_SHARED | MAP_ANONYMOUS, -1, 0);
	snprintf(message, PAINTER_MESSAGE, "out of memory");
	if (painter->colour == MAP_FAILED)
		return -ENOMEM;
	painter->depth = painter->colour + pixels;
	ret = begin(painter, scene);
	if (!ret)
		ret = hear(painter, &answer);
	snprintf(message, PAINTER_MESSAGE, "%s",
		 !ret || ret == -ENODEV ? answer.message : "its process has ended");
	if (ret)
		painter_stop(painter);
	return ret;
}

int painter_draw(struct painter *painter, const struct scene *scene, struct painter_cost *cost)
{
	struct request request = { .scene = *scene };
	struct answer answer;
	int ret = ask(painter, &request, &answer);

	if (!ret && cost)
		*cost = answer.cost;
	return ret;
}

int painter_picture(struct painter *painter, const struct scene *scene)
{
	struct request request = { .scene = *scene, .read = true };
	struct answer answer;

	request.scene.keeps_depth = true;
	return ask(painter, &request, &answer);
}

void painter_stop(struct painter *painter)
{
	if (!painter->way)
		return;
	close(painter->link);
	if (painter->process > 0) {
		kill(painter->process, SIGKILL);
		waitpid(painter->process, NULL, 0);
	}
	munmap(painter->colour, painter->pixels * 2 * sizeof(uint32_t));
	painter->way = NULL;
}
