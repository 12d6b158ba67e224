/* SPDX-License-Identifier: MIT */
/* QEMU's end of a qtest socket, that answers when the test says so. */
#ifndef VBOARD_TEST_QTEST_H
#define VBOARD_TEST_QTEST_H

#include <poll.h>
#include <pthread.h>
#include <stdbool.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include "accel_test.h"

/*
 * Who waits for an answer waits for ever, instead of for the second that a QEMU gets; so what is
 * not to be waited for is seen to hang. Link with --wrap=pthread_cond_clockwait.
 */
int __wrap_pthread_cond_clockwait(pthread_cond_t *cond, pthread_mutex_t *mutex, clockid_t clock,
				  const struct timespec *until);

int __wrap_pthread_cond_clockwait(pthread_cond_t *cond, pthread_mutex_t *mutex, clockid_t clock,
				  const struct timespec *until)
{
	(void)clock;
	(void)until;
	return pthread_cond_wait(cond, mutex);
}

struct test_qtest {
	char folder[64];
	struct sockaddr_un address;
	int listener, socket;
};

/* A name for the socket, which is not there yet. */
static inline void test_qtest_init(struct test_qtest *qtest)
{
	*qtest = (struct test_qtest){
		.folder = "/tmp/vboard-test-XXXXXX",
		.listener = -1,
		.socket = -1,
		.address = { .sun_family = AF_UNIX },
	};
	alarm(test_patience_s());
	assert_non_null(mkdtemp(qtest->folder));
	snprintf(qtest->address.sun_path, sizeof(qtest->address.sun_path), "%s/qtest",
		 qtest->folder);
}

/* Listens, until somebody has connected. */
static inline void test_qtest_accept(struct test_qtest *qtest)
{
	qtest->listener = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
	assert_int_equal(bind(qtest->listener, (struct sockaddr *)&qtest->address,
			      sizeof(qtest->address)),
			 0);
	assert_int_equal(listen(qtest->listener, 1), 0);
	qtest->socket = accept(qtest->listener, NULL, NULL);
	assert_true(qtest->socket >= 0);
}

static inline void test_qtest_fini(struct test_qtest *qtest)
{
	close(qtest->socket);
	close(qtest->listener);
	unlink(qtest->address.sun_path);
	rmdir(qtest->folder);
}

static inline bool test_qtest_has_more(const struct test_qtest *qtest, int milliseconds)
{
	struct pollfd polls = { .fd = qtest->socket, .events = POLLIN };

	return poll(&polls, 1, milliseconds) > 0;
}

static inline void test_qtest_answer(const struct test_qtest *qtest, const char *answer)
{
	ssize_t length = (ssize_t)strlen(answer);

	assert_int_equal(send(qtest->socket, answer, (size_t)length, MSG_NOSIGNAL), length);
}

/* The next command has to be @expected. It gets no answer. */
static inline void test_qtest_expect(const struct test_qtest *qtest, const char *expected)
{
	char line[128];
	size_t length = 0;

	do {
		assert_true(length < sizeof(line) &&
			    test_qtest_has_more(qtest, test_patience_ms()));
		assert_int_equal(recv(qtest->socket, line + length, 1, 0), 1);
	} while (line[length++] != '\n');
	line[length - 1] = '\0';
	assert_string_equal(line, expected);
}

static inline void test_qtest_expect_pin(const struct test_qtest *qtest, int pin, int level)
{
	char expected[128];

	snprintf(expected, sizeof(expected), "set_irq_in /machine/q35/ioapic unnamed-gpio-in %d %d",
		 pin, level);
	test_qtest_expect(qtest, expected);
}

/* Answers all that has come. */
static inline void test_qtest_answer_all(const struct test_qtest *qtest)
{
	char commands[4096];
	ssize_t i, length;

	if (!test_qtest_has_more(qtest, 0))
		return;
	length = recv(qtest->socket, commands, sizeof(commands), 0);
	for (i = 0; i < length; i++)
		if (commands[i] == '\n')
			test_qtest_answer(qtest, "OK\n");
}

#endif
