// SPDX-License-Identifier: MIT
/*
 * Whatever goes wrong between the library and a board on USB, at whatever moment: the jobs that
 * were under way have the right answers or end with an error, and those after them are right.
 * GLOSS_POINTS says how often something goes wrong, if not POINTS times. As root, for the kernel's
 * messages.
 */
#include <errno.h>
#include <inttypes.h>
#include <signal.h>
#include <sys/wait.h>

#include "accel.h"
#include "gloss_packets.h"
#include "usb_cable.h"
#include "vboard/usb/faults.h"
#include "vm_test.h"

enum {
	POINTS = 100,
	JOBS = 4,        /* under way at once */
	WORDS_LOG2 = 16, /* of a job, at most */
	REPLUG_MS = 50,
	CHILD_MS = 150, /* that a client lives */
	WAIT_S = 30,    /* for a job: that is a hang */
};

/* What a fault may lead to; one that is no fault at all to nothing. */
enum { FAILS = 1, GONE = 2 };

static const struct fault {
	const char *name;
	uint32_t offset;   /* in the fault window */
	unsigned int log2; /* the count is 1 to 2^log2 */
	unsigned int weight;
	unsigned int leads_to;
} faults[] = {
	{ "unplug", VBOARD_USB_FAULT_UNPLUG, 4, 12, FAILS | GONE },
	{ "stall out", VBOARD_USB_FAULT_STALL_OUT, 3, 16, FAILS },
	{ "stall in", VBOARD_USB_FAULT_STALL_IN, 3, 16, FAILS },
	{ "short in", VBOARD_USB_FAULT_SHORT_IN, 3, 16, 0 },
	{ "empty in", VBOARD_USB_FAULT_EMPTY_IN, 2, 16, 0 },
	{ "delay", VBOARD_USB_FAULT_DELAY, 14, 12, 0 },
	{ "garbage", VBOARD_USB_FAULT_GARBAGE, 8, 16, FAILS },
	{ "hang", VBOARD_USB_FAULT_HANG, 2, 3, FAILS },
	{ "lose out", VBOARD_USB_FAULT_LOSE_OUT, 2, 3, FAILS },
	{ "refuse control", VBOARD_USB_FAULT_REFUSE_CONTROL, 1, 8, FAILS },
	{ "exit", VBOARD_USB_FAULT_EXIT, 3, 2, FAILS | GONE },
};

#define FAULTS (sizeof(faults) / sizeof(faults[0]))

/* A job that writes random words to board memory, and reads them back. */
struct job {
	struct accel_stream *stream;
	struct accel_buffer *buffer;
	struct accel_fence *fence;
	uint32_t count;
	uint32_t word[1 << WORDS_LOG2], answer[1 << WORDS_LOG2];
	int result;
};

static const char *board;
static struct usb_cable *cable;
static struct accel_device *device;
static struct job jobs[JOBS];
static uint64_t random_state;
static unsigned int points_of[FAULTS], failed_of[FAULTS], points_killed;

static uint32_t random_word(void)
{
	uint64_t z = random_state += 0x9e3779b97f4a7c15;

	z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9;
	z = (z ^ z >> 27) * 0x94d049bb133111eb;
	return (uint32_t)(z ^ z >> 31);
}

static uint32_t random_below(uint32_t limit)
{
	return random_word() % limit;
}

/* 1 to 2^log2, small ones as often as large ones. */
static uint32_t random_count(unsigned int log2)
{
	uint32_t limit = 1u << random_below(log2 + 1);

	return 1 + random_below(limit);
}

/* ---- the device ---- */

static void say(void *data, const char *message)
{
	(void)data;
	VM_PRINT("    %s\n", message);
}

static void device_close(void)
{
	if (!device)
		return;
	for (int n = 0; n < JOBS; n++) {
		accel_stream_free(jobs[n].stream);
		accel_buffer_free(jobs[n].buffer);
		jobs[n].stream = NULL;
		jobs[n].buffer = NULL;
	}
	accel_device_free(device);
	device = NULL;
}

/* 0, or as the library says; then it is closed. */
static int device_open(void)
{
	int err = accel_device_new(board, say, NULL, &device);

	if (err) {
		device = NULL;
		return err;
	}
	for (int n = 0; n < JOBS && !err; n++) {
		err = accel_buffer_new(device, sizeof(jobs[n].word), &jobs[n].buffer);
		if (!err)
			err = accel_stream_new(device, &jobs[n].stream);
	}
	if (err)
		device_close();
	return err;
}

/* The node of a board that was just plugged in has to get its mode first. */
static void device_must_open(void)
{
	int left = vm_patience_ms(), err;

	while ((err = device_open()) == -ENODEV || err == -EACCES) {
		left -= 10;
		if (left < 0)
			break;
		usleep(10 * 1000);
	}
	if (err)
		vm_fail("%s does not open: %s", board, strerror(-err));
}

/* ---- jobs ---- */

static void emit_job(struct job *job)
{
	const uint32_t most = GLOSS_LENGTH_MAX - 2;
	const struct gloss_read_memory read = { .count = job->count };
	uint32_t words[1 + GLOSS_LENGTH_MAX];

	accel_stream_reset(job->stream);
	if (accel_stream_slot(job->stream, job->buffer, ACCEL_SLOT_READ | ACCEL_SLOT_WRITE) < 0)
		vm_fail("no slot");
	for (uint32_t at = 0; at < job->count;) {
		uint32_t now = job->count - at < most ? job->count - at : most;
		const struct gloss_write_memory write = { .offset = 4 * at };

		gloss_write_memory_pack(words, &write, 2 + now);
		memcpy(words + 3, job->word + at, 4 * (size_t)now);
		if (accel_stream_emit(job->stream, words, 3 + now))
			vm_fail("out of memory");
		at += now;
	}
	gloss_read_memory_pack(words, &read);
	if (accel_stream_emit(job->stream, words, 1 + GLOSS_READ_MEMORY_WORDS))
		vm_fail("out of memory");
}

static void submit_job(struct job *job)
{
	job->count = random_count(WORDS_LOG2 - 1);
	for (uint32_t n = 0; n < job->count; n++)
		job->word[n] = random_word();
	memset(job->answer, 0, sizeof(job->answer));
	emit_job(job);
	job->fence = NULL;
	job->result = accel_stream_submit(job->stream, job->answer, job->count, &job->fence);
}

static void wait_job(struct job *job)
{
	struct accel_fence_status status = { 0 };

	if (job->fence) {
		job->result = accel_fence_wait(job->fence, WAIT_S * INT64_C(1000000000), &status,
					       sizeof(status));
		if (job->result == -ETIMEDOUT)
			vm_fail("a job does not end");
		accel_fence_free(job->fence);
		if (status.fault)
			vm_fail("a job ends with fault %u", status.fault);
	}
	if (job->result && job->result != -EIO && job->result != -ENODEV)
		vm_fail("a job ends with %s", strerror(-job->result));
}

static void check_answer(const struct job *job)
{
	for (uint32_t n = 0; n < job->count; n++)
		if (job->answer[n] != job->word[n])
			vm_fail("word %u of %u is wrong in a job that ended well", n, job->count);
}

/* How many failed; *@gone: one of them because the board is gone. */
static int run_jobs(bool *gone)
{
	int failed = 0;

	for (int n = 0; n < JOBS; n++)
		submit_job(&jobs[n]);
	for (int n = 0; n < JOBS; n++) {
		wait_job(&jobs[n]);
		*gone |= jobs[n].result == -ENODEV;
		failed += jobs[n].result != 0;
		if (!jobs[n].result)
			check_answer(&jobs[n]);
	}
	return failed;
}

static void jobs_must_run(void)
{
	bool gone = false;

	if (run_jobs(&gone))
		vm_fail("nothing is wrong any more, and a job ends with %s",
			gone ? strerror(ENODEV) : strerror(EIO));
}

/* ---- points ---- */

static size_t choose_fault(void)
{
	uint32_t sum = 0, at;
	size_t n = 0;

	for (size_t i = 0; i < FAULTS; i++)
		sum += faults[i].weight;
	for (at = random_below(sum); at >= faults[n].weight; n++)
		at -= faults[n].weight;
	return n;
}

static void arm(const struct fault *fault)
{
	uint32_t count = random_count(fault->log2);

	VM_PRINT("  %s %u\n", fault->name, count);
	if (!usb_cable_arm(cable, VBOARD_USB_FAULT_REPLUG, REPLUG_MS) ||
	    !usb_cable_arm(cable, fault->offset, count))
		vm_fail("the board is not there");
}

/* Everything as before the point. */
static void recover(bool gone)
{
	if (!usb_cable_disarm(cable) || gone) {
		device_close();
		usb_cable_close(cable);
		cable = usb_cable_open(board);
		usb_cable_disarm(cable);
	}
	if (!device)
		device_must_open();
	jobs_must_run();
}

/* One fault, or two. */
static void point_fault(void)
{
	size_t first = choose_fault(), second = choose_fault();
	bool two = random_below(4) == 0, opens = random_below(8) == 0, gone = false;
	unsigned int leads_to = faults[first].leads_to | (two ? faults[second].leads_to : 0);
	int failed = 0;

	if (opens)
		device_close();
	arm(&faults[first]);
	if (two && first != second)
		arm(&faults[second]);
	/* One that does not answer is not there, for who wants to open it. */
	if (opens)
		failed = device_open();
	if (device)
		failed = run_jobs(&gone);
	if (failed && !(leads_to & FAILS))
		vm_fail("%d jobs fail, though nothing was wrong", failed);
	if (gone && !(leads_to & GONE))
		vm_fail("the board is gone");
	points_of[first]++;
	failed_of[first] += failed != 0;
	recover(gone || (opens && failed));
}

/* Another program, which has the board until it is killed. */
__attribute__((noreturn)) static void client(void)
{
	bool gone = false;

	device_must_open();
	if (write(STDOUT_FILENO, "", 1) != 1)
		exit(VM_FAIL);
	for (;;)
		run_jobs(&gone);
}

static pid_t start_client(int *from)
{
	char seed[32];
	int ends[2];
	pid_t pid;

	snprintf(seed, sizeof(seed), "%u", random_word());
	if (pipe(ends))
		vm_fail("pipe: %s", strerror(errno));
	pid = fork();
	if (!pid) {
		dup2(ends[1], STDOUT_FILENO);
		close(ends[0]);
		execl("/proc/self/exe", "client", board, seed, NULL);
		_exit(127);
	}
	close(ends[1]);
	*from = ends[0];
	return pid;
}

static void point_kill(void)
{
	char ready;
	int from, status;
	pid_t pid;

	VM_PRINT("  a client is killed\n");
	device_close();
	pid = start_client(&from);
	if (pid < 0 || read(from, &ready, 1) != 1)
		vm_fail("the client does not start");
	usleep(random_below(CHILD_MS * 1000));
	if (kill(pid, SIGKILL) || waitpid(pid, &status, 0) != pid || !WIFSIGNALED(status))
		vm_fail("the client ended by itself");
	close(from);
	points_killed++;
	recover(false);
}

static void run_points(const char *name, int points)
{
	board = name;
	cable = usb_cable_open(board);
	usb_cable_disarm(cable);
	device_must_open();
	for (int n = 0; n < points; n++) {
		VM_PRINT("%s, point %d\n", board, n);
		if (random_below(25) == 0)
			point_kill();
		else
			point_fault();
	}
	device_close();
	usb_cable_close(cable);
}

int main(int argc, char **argv)
{
	const char *given = getenv("GLOSS_POINTS");
	int points = given && *given ? atoi(given) : POINTS;

	if (argc == 3) {
		board = argv[1];
		random_state = strtoull(argv[2], NULL, 10);
		client();
	}
	random_state = vm_seed();
	/* What QEMU's controller and the kernel's driver say when a board goes at a bad moment. */
	vm_expect("xhci_hcd .*: WARN Set TR Deq Ptr cmd failed");
	run_points(vm_env("GLOSS_USB_MODEL"), points - points / 5);
	run_points(vm_env("GLOSS_USB_RTL"), points / 5);
	vm_expect_end();
	for (size_t i = 0; i < FAULTS; i++)
		VM_PRINT("%s: %u times, jobs failed %u times\n", faults[i].name, points_of[i],
			 failed_of[i]);
	VM_PRINT("clients killed: %u\n", points_killed);
	return VM_PASS;
}
