/* SPDX-License-Identifier: MIT */
/*
 * Jobs and pictures on a board whose cable fails at a random point, each case in another way.
 * What is under way then ends in a clean error or in the right bytes, also when words are lost or
 * others come in their place. Nothing hangs, and nothing is left behind; afterwards the same
 * device works again, or says that it is gone, and the next one that is opened works at once:
 * also when the host before it died in the middle of a job.
 * A case follows from the seed and its number, but for which thread comes first.
 */
#include <dlfcn.h>
#include <errno.h>
#include <getopt.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "accel_test.h"
#include "usb_fault.h"
#include "usb_trial.h"

#define RETRIES 3
#define TOLD_NS 1500000000ll
#define ENDS_NS 100000000000ll /* of the library's time: it may try again */
#define DEPTH 4                /* transfers in flight, at least */

/* Outside; what takes long here takes a tenth of a second. */
static unsigned int hang_seconds(void)
{
	const char *slow = getenv("GLOSS_SLOW");

	return slow && atoi(slow) > 0 ? 120 * (unsigned int)atoi(slow) : 120;
}

/* What became of the cases of one kind of fault. */
struct count {
	unsigned int cases, fired, right, io, gone, other;
};

struct test {
	const char *name;                      /* of the device */
	const struct gloss_usb_board_ops *rtl; /* NULL: the model of the board */
	uint64_t seed, number;
	struct accel_device *model[2]; /* with tiles of 32 and 64 pixels */
	struct count count[USB_FAULT_CALL + 1];
	unsigned int depth_out, depth_in; /* most transfers in flight */
	char text[512];
};

/* ---- a case ---- */

struct second {
	struct accel_device *device, *model;
	uint64_t seed;
	int err;
};

static void *second_run(void *data)
{
	struct second *second = data;

	second->err = usb_trial_run(second->device, second->model, second->seed);
	return NULL;
}

/* After jobs that were done: a core has taken time for them, and a model does not know. */
static void check_clocks(const struct test *test, struct accel_device *device)
{
	struct accel_device_clocks clocks;
	int err = accel_device_clocks(device, &clocks, sizeof(clocks));

	if (test->rtl && (err == -ENOTSUP || (!err && !clocks.clocks)))
		usb_trial_fail("the core has no clock");
	if (!test->rtl && !err && clocks.clocks)
		usb_trial_fail("the model counts clocks");
}

/* In one thread, or in two that share the device. */
static int work(struct test *test, struct accel_device *device, uint64_t *seed)
{
	struct accel_device_info info;
	struct accel_device *model;
	struct second second;
	bool both = test_below(seed, 4) == 0;
	pthread_t thread;
	int err;

	accel_device_info(device, &info, sizeof(info));
	model = test->model[info.tile_size == 64];
	second = (struct second){ device, model, test_random(seed), 0 };
	if (both && pthread_create(&thread, NULL, second_run, &second))
		usb_trial_fail("no thread");
	err = usb_trial_run(device, model, test_random(seed));
	if (both)
		pthread_join(thread, NULL);
	if (!err && !second.err)
		check_clocks(test, device);
	return err ? err : second.err;
}

static void plug_in(const struct test *test, uint64_t *seed)
{
	struct fake_usb_board *board = &fake_usb.board[0];
	bool small = test_below(seed, 4) == 0, fast = test_below(seed, 2);

	fake_usb_start(test_random(seed));
	fake_usb_unplug(0);
	if (test->rtl)
		board->ops = test->rtl;
	else if (small)
		board->ops = &gloss_usb_board_model_t32;
	board->speed = fast ? LIBUSB_SPEED_SUPER : LIBUSB_SPEED_HIGH;
	board->endpoint[0].packet_bytes = board->endpoint[1].packet_bytes = fast ? 1024 : 512;
	fake_usb_plug(0, true);
}

static int open_device(const struct test *test, struct accel_device **device)
{
	int err = accel_device_new(test->name, NULL, NULL, device);

	if (err)
		*device = NULL;
	return err;
}

static void check_open_error(int err)
{
	if (err && err != -EIO && err != -ENODEV && err != -ENOMEM && err != -EACCES &&
	    err != -EBUSY)
		usb_trial_fail("opening ended with %s", strerror(-err));
}

static void count_result(struct count *count, int err)
{
	count->cases++;
	count->fired += fake_usb_fired() != 0;
	count->right += !err;
	count->io += err == -EIO;
	count->gone += err == -ENODEV;
	count->other += err && err != -EIO && err != -ENODEV;
}

/* Until what the fault has left, and nobody has met yet, is met; or the device says it is gone. */
static void recover(struct test *test, struct accel_device *device, uint64_t *seed)
{
	int err = -EIO;

	for (int n = 0; n < RETRIES && err == -EIO; n++)
		err = work(test, device, seed);
	if (err && err != -ENODEV)
		usb_trial_fail("%d jobs after the fault there is still: %s", RETRIES,
			       strerror(-err));
}

static void check_next(struct test *test, uint64_t *seed)
{
	struct accel_device *device;
	int err = open_device(test, &device);

	if (err)
		usb_trial_fail("the next one does not open: %s", strerror(-err));
	err = work(test, device, seed);
	if (err)
		usb_trial_fail("the next one fails: %s", strerror(-err));
	accel_device_free(device);
}

static void check_result(const struct usb_faults *faults, int err, int64_t waited_ns)
{
	if (waited_ns > ENDS_NS && !usb_faults_any(faults, usb_fault_delays))
		usb_trial_fail("it took %lld s to end", (long long)waited_ns / 1000000000);
	if (waited_ns > TOLD_NS && usb_faults_all(faults, usb_fault_is_told))
		usb_trial_fail("it took %lld ms to be noticed", (long long)waited_ns / 1000000);
	if (err && !fake_usb_fired())
		usb_trial_fail("%s, and there was no fault yet", strerror(-err));
	if (err && err != -ENODEV && usb_faults_all(faults, usb_fault_ends_host))
		usb_trial_fail("%s, and the board was gone", strerror(-err));
	if (err && usb_faults_all(faults, usb_fault_harmless))
		usb_trial_fail("%s, and there was nothing wrong", strerror(-err));
}

static void case_name(struct test *test, const struct usb_faults *faults)
{
	size_t room = sizeof(test->text), length;

	length = (size_t)snprintf(test->text, room, "case %llu (",
				  (unsigned long long)test->number);
	for (int n = 0; n < faults->count; n++) {
		const struct usb_fault *fault = &faults->fault[n];

		length += (size_t)snprintf(test->text + length, room - length,
					   "%s at %llu, value %u, error %d%s; ",
					   usb_fault_name(fault->kind),
					   (unsigned long long)fault->at, fault->value,
					   fault->error, fault->early ? ", early" : "");
	}
	snprintf(test->text + length, room - length,
		 "GLOSS_SEED=%llu test_usb_faults -g %llu -n 1 repeats it)",
		 (unsigned long long)test->seed, (unsigned long long)test->number);
	usb_trial_context(test->text);
}

/* Returns what became of it; the device may be NULL then. */
static int case_work(struct test *test, const struct usb_faults *faults, uint64_t *seed,
		     struct accel_device **device)
{
	int64_t before = fake_usb_leapt_ns();
	int err;

	usb_faults_arm(faults, true);
	err = open_device(test, device);
	check_open_error(err);
	usb_faults_arm(faults, false);
	if (!err)
		err = work(test, *device, seed);
	check_result(faults, err, fake_usb_leapt_ns() - before);
	count_result(&test->count[faults->fault[0].kind], err);
	return err;
}

/* A dead host can not close its board; what is left of it here does so later. */
static void case_next(struct test *test, bool dead, uint64_t *seed, struct accel_device *device)
{
	if (dead)
		fake_usb_kill();
	else
		accel_device_free(device);
	if (!fake_usb.board[0].present)
		fake_usb_plug(0, test_below(seed, 2));
	check_next(test, seed);
	if (dead)
		accel_device_free(device);
}

static void run_case(struct test *test)
{
	uint64_t seed = test->seed * 0x9e3779b97f4a7c15 + test->number * 0xd1342543de82ef95;
	struct usb_faults faults = usb_faults_choose(&seed);
	struct accel_device *device;
	int err;

	case_name(test, &faults);
	alarm(hang_seconds());
	plug_in(test, &seed);
	err = case_work(test, &faults, &seed, &device);
	fake_usb_disarm();
	if (device && !usb_faults_any(&faults, usb_fault_ends_host) && err != -ENODEV)
		recover(test, device, &seed);
	case_next(test, usb_faults_any(&faults, usb_fault_kills), &seed, device);
	if (test->depth_out < fake_usb.depth_out)
		test->depth_out = fake_usb.depth_out;
	if (test->depth_in < fake_usb.depth_in)
		test->depth_in = fake_usb.depth_in;
	fake_usb_stop();
}

/* ---- all of them ---- */

static struct test test = { .name = "usb:" };

static void say_hang(int signal)
{
	(void)signal;
	if (write(2, test.text, strlen(test.text)) >= 0 && write(2, ": it hangs\n", 11) >= 0)
		abort();
}

static const struct gloss_usb_board_ops *load_board(const char *path)
{
	void *plugin = dlopen(path, RTLD_NOW | RTLD_LOCAL);
	const struct gloss_usb_board_ops *ops;

	if (!plugin)
		usb_trial_fail("%s", dlerror());
	ops = dlsym(plugin, GLOSS_USB_BOARD_SYMBOL);
	if (!ops || ops->abi != GLOSS_USB_BOARD_ABI || ops->version != GLOSS_VERSION)
		usb_trial_fail("%s is no plugin of this tree", path);
	return ops;
}

static int report(const struct test *t)
{
	unsigned int cases = 0, fired = 0;

	printf("%-16s %6s %6s %6s %6s %6s %6s\n", "fault", "cases", "came", "fine", "EIO", "ENODEV",
	       "other");
	for (int kind = 1; kind <= USB_FAULT_CALL; kind++) {
		const struct count *c = &t->count[kind];

		printf("%-16s %6u %6u %6u %6u %6u %6u\n", usb_fault_name(kind), c->cases, c->fired,
		       c->right, c->io, c->gone, c->other);
		cases += c->cases;
		fired += c->fired;
	}
	printf("%u cases, in %u of them the fault came; up to %u transfers out and %u in at once\n",
	       cases, fired, t->depth_out, t->depth_in);
	if (cases < 100 || (fired >= cases / 2 && t->depth_out >= DEPTH && t->depth_in >= DEPTH))
		return 0;
	fprintf(stderr, "test_usb_faults: too few faults, or transfers: this tests little\n");
	return 1;
}

int main(int argc, char **argv)
{
	const char *seed = getenv("GLOSS_SEED"), *count = getenv("USB_FAULTS");
	uint64_t first = 0, cases = count && *count ? strtoull(count, NULL, 0) : 1000;
	int option;

	test.seed = seed && *seed ? strtoull(seed, NULL, 0) : (uint64_t)time(NULL);
	while ((option = getopt(argc, argv, "n:g:d:b:")) >= 0) {
		if (option == 'n')
			cases = strtoull(optarg, NULL, 0);
		else if (option == 'g')
			first = strtoull(optarg, NULL, 0);
		else if (option == 'd')
			test.name = optarg;
		else if (option == 'b')
			test.rtl = load_board(optarg);
		else
			return 2;
	}
	printf("GLOSS_SEED=%llu\n", (unsigned long long)test.seed);
	signal(SIGALRM, say_hang);
	for (unsigned int n = 0; n < 2; n++)
		test.model[n] = usb_trial_model(32 << n);
	for (test.number = first; test.number < first + cases; test.number++)
		run_case(&test);
	for (int n = 0; n < 2; n++)
		accel_device_free(test.model[n]);
	return report(&test);
}
