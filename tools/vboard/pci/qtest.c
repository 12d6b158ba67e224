// SPDX-License-Identifier: MIT
#define _GNU_SOURCE
#include <errno.h>
#include <inttypes.h>
#include <poll.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <time.h>
#include <unistd.h>

#include "vboard/pci/qtest.h"

#define RETRY_MS 20
/* A QEMU that takes longer to answer waits for us. */
#define ANSWER_SECONDS 1

#define IO_APIC "/machine/q35/ioapic"
#define IO_APIC_PINS 24

struct vboard_qtest {
	struct sockaddr_un address;
	int stop;             /* eventfd: end the thread */
	pthread_t thread;     /* connects, and reads answers */
	pthread_mutex_t lock; /* protects the following members */
	pthread_cond_t answered_more;
	int socket; /* -1: not connected */
	bool gone;  /* QEMU was there and has ended */
	bool complained;
	uint64_t sent, answered;           /* commands */
	unsigned int raised[IO_APIC_PINS]; /* boards that hold the pin up */
};

/* q35 leads INTA of slot n to PIRQ E to H, and those to pins 20 to 23. */
static unsigned int qtest_pin(unsigned int slot)
{
	return 20 + slot % 4;
}

/* ---- answers ---- */

static void qtest_complain(struct vboard_qtest *qtest, const char *what)
{
	if (!qtest->complained)
		fprintf(stderr, "vboard-pci: %s: %s\n", qtest->address.sun_path, what);
	qtest->complained = true;
}

static void qtest_take_line(struct vboard_qtest *qtest, const char *line)
{
	pthread_mutex_lock(&qtest->lock);
	if (strncmp(line, "OK", 2) != 0)
		qtest_complain(qtest, line);
	qtest->answered++;
	pthread_cond_broadcast(&qtest->answered_more);
	pthread_mutex_unlock(&qtest->lock);
}

/* Waits for @fd, or @timeout ms; false: it is time to stop. */
static bool qtest_poll(struct vboard_qtest *qtest, int fd, int timeout)
{
	struct pollfd polls[] = {
		{ .fd = qtest->stop, .events = POLLIN },
		{ .fd = fd, .events = POLLIN },
	};

	while (poll(polls, 2, timeout) < 0 && errno == EINTR)
		;
	return !polls[0].revents;
}

static void qtest_read(struct vboard_qtest *qtest)
{
	char line[256];
	size_t length = 0;
	ssize_t got;

	while (qtest_poll(qtest, qtest->socket, -1)) {
		char *end;

		got = recv(qtest->socket, line + length, sizeof(line) - 1 - length, 0);
		if (got <= 0)
			return;
		length += (size_t)got;
		line[length] = '\0';
		while ((end = strchr(line, '\n'))) {
			*end = '\0';
			qtest_take_line(qtest, line);
			length -= (size_t)(end + 1 - line);
			memmove(line, end + 1, length + 1);
		}
		if (length == sizeof(line) - 1)
			length = 0; /* no answer is that long */
	}
}

/* With the lock, so that whoever hears of the connection finds it. */
static bool qtest_connect(struct vboard_qtest *qtest)
{
	const struct sockaddr *address = (const struct sockaddr *)&qtest->address;
	bool connected;
	int fd;

	pthread_mutex_lock(&qtest->lock);
	fd = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
	connected = fd >= 0 && !connect(fd, address, sizeof(qtest->address));
	if (connected)
		qtest->socket = fd;
	else if (fd >= 0)
		close(fd);
	pthread_mutex_unlock(&qtest->lock);
	return connected;
}

static void *qtest_thread(void *data)
{
	struct vboard_qtest *qtest = data;

	while (!qtest_connect(qtest))
		if (!qtest_poll(qtest, -1, RETRY_MS))
			return NULL;
	qtest_read(qtest);
	pthread_mutex_lock(&qtest->lock);
	close(qtest->socket);
	qtest->socket = -1;
	qtest->gone = true;
	qtest->answered = qtest->sent;
	pthread_cond_broadcast(&qtest->answered_more);
	pthread_mutex_unlock(&qtest->lock);
	return NULL;
}

/* ---- commands; with the lock ---- */

static void qtest_send(struct vboard_qtest *qtest, const char *command)
{
	if (qtest->socket < 0 && !qtest->gone)
		qtest_complain(qtest, "an interrupt is lost: QEMU does not listen here");
	if (qtest->socket >= 0 && send(qtest->socket, command, strlen(command), MSG_NOSIGNAL) >= 0)
		qtest->sent++;
}

static void qtest_wait(struct vboard_qtest *qtest)
{
	uint64_t number = qtest->sent;
	struct timespec until;

	clock_gettime(CLOCK_MONOTONIC, &until);
	until.tv_sec += ANSWER_SECONDS;
	while (qtest->answered < number)
		if (pthread_cond_clockwait(&qtest->answered_more, &qtest->lock, CLOCK_MONOTONIC,
					   &until))
			return;
}

void vboard_qtest_message(struct vboard_qtest *qtest, uint64_t address, uint16_t data)
{
	char command[64];

	snprintf(command, sizeof(command), "writel 0x%" PRIx64 " 0x%x\n", address, data);
	pthread_mutex_lock(&qtest->lock);
	qtest_send(qtest, command);
	pthread_mutex_unlock(&qtest->lock);
}

void vboard_qtest_level(struct vboard_qtest *qtest, unsigned int slot, bool level, bool wait)
{
	unsigned int pin = qtest_pin(slot), before;
	char command[80];

	snprintf(command, sizeof(command), "set_irq_in " IO_APIC " unnamed-gpio-in %u %d\n", pin,
		 level);
	pthread_mutex_lock(&qtest->lock);
	before = qtest->raised[pin];
	qtest->raised[pin] += level ? 1u : -1u;
	if (!before != !qtest->raised[pin])
		qtest_send(qtest, command);
	if (wait)
		qtest_wait(qtest);
	pthread_mutex_unlock(&qtest->lock);
}

/* ---- beginning and end ---- */

int vboard_qtest_new(const char *path, struct vboard_qtest **to)
{
	struct vboard_qtest *qtest;
	int err;

	if (strlen(path) >= sizeof(qtest->address.sun_path))
		return -ENAMETOOLONG;
	qtest = calloc(1, sizeof(*qtest));
	if (!qtest)
		return -ENOMEM;
	qtest->address.sun_family = AF_UNIX;
	memcpy(qtest->address.sun_path, path, strlen(path));
	qtest->socket = -1;
	pthread_mutex_init(&qtest->lock, NULL);
	pthread_cond_init(&qtest->answered_more, NULL);
	qtest->stop = eventfd(0, EFD_CLOEXEC);
	err = qtest->stop < 0 ? -errno : 0;
	if (!err)
		err = -pthread_create(&qtest->thread, NULL, qtest_thread, qtest);
	if (err)
		goto err_free;
	*to = qtest;
	return 0;

err_free:
	if (qtest->stop >= 0)
		close(qtest->stop);
	pthread_cond_destroy(&qtest->answered_more);
	pthread_mutex_destroy(&qtest->lock);
	free(qtest);
	return err;
}

void vboard_qtest_free(struct vboard_qtest *qtest)
{
	if (!qtest)
		return;
	eventfd_write(qtest->stop, 1);
	pthread_join(qtest->thread, NULL);
	close(qtest->stop);
	pthread_cond_destroy(&qtest->answered_more);
	pthread_mutex_destroy(&qtest->lock);
	free(qtest);
}
