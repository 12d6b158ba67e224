/* SPDX-License-Identifier: MIT */
/* The bus of fake_usb.h as a test has it in hand. */
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fake_usb_priv.h"

struct fake_usb fake_usb;
struct fake_state fake = {
	.mutex = PTHREAD_MUTEX_INITIALIZER,
	.turn = PTHREAD_COND_INITIALIZER,
};

static uint8_t memory[FAKE_USB_BOARDS][FAKE_USB_BOARD_BYTES] __attribute__((aligned(4096)));

/* ---- the lock ---- */

/* In the order in which they came: who always wants it again would keep it for himself else. */
static void lock_take(void)
{
	unsigned int ticket = fake.next_ticket++;

	while (fake.ticket != ticket)
		pthread_cond_wait(&fake.turn, &fake.mutex);
}

static void lock_pass_on(void)
{
	fake.ticket++;
	if (fake.ticket != fake.next_ticket)
		pthread_cond_broadcast(&fake.turn);
}

void fake_lock(void)
{
	pthread_mutex_lock(&fake.mutex);
	lock_take();
	pthread_mutex_unlock(&fake.mutex);
}

void fake_unlock(void)
{
	pthread_mutex_lock(&fake.mutex);
	lock_pass_on();
	pthread_mutex_unlock(&fake.mutex);
}

void fake_give_way(void)
{
	pthread_mutex_lock(&fake.mutex);
	lock_pass_on();
	lock_take();
	pthread_mutex_unlock(&fake.mutex);
}

void fake_wait(int64_t deadline, int64_t due)
{
	pthread_mutex_lock(&fake.mutex);
	lock_pass_on();
	fake_clock_wait(&fake.changed, &fake.mutex, deadline, due);
	lock_take();
	pthread_mutex_unlock(&fake.mutex);
}

void fake_violation(const char *format, ...)
{
	va_list arguments;

	va_start(arguments, format);
	fprintf(stderr, "fake_usb: ");
	vfprintf(stderr, format, arguments);
	fprintf(stderr, "\n");
	va_end(arguments);
	abort();
}

/* splitmix64 */
uint32_t fake_random(void)
{
	uint64_t z = fake.seed += 0x9e3779b97f4a7c15;

	z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9;
	z = (z ^ z >> 27) * 0x94d049bb133111eb;
	return (uint32_t)((z ^ z >> 31) >> 32);
}

uint32_t fake_below(uint32_t limit)
{
	return (uint32_t)((uint64_t)fake_random() * limit >> 32);
}

int fake_call(const char *function)
{
	fake_usb.calls++;
	if (fake.fail_always && !strcmp(fake.fail_function, function))
		return fake.fail_error;
	if (!fake.fail_at || (fake.fail_function && strcmp(fake.fail_function, function) != 0) ||
	    --fake.fail_at)
		return 0;
	fake_usb.fired++;
	return fake.fail_error;
}

/* ---- start and end ---- */

static void board_default(struct fake_usb_board *board)
{
	*board = (struct fake_usb_board){
		.ops = &gloss_usb_board_model_t64,
		.speed = LIBUSB_SPEED_HIGH,
		.vendor = GLOSS_USB_VENDOR,
		.product = GLOSS_USB_PRODUCT,
		.manufacturer_text = "Gloss",
		.product_text = "Gloss board",
		.serial = "VIRTUAL0",
		.interfaces = FAKE_INTERFACES,
		.interface_class = 0xff,
		.interface_subclass = GLOSS_USB_SUBCLASS,
		.interface_protocol = GLOSS_USB_PROTOCOL,
		.endpoints = 3,
		.endpoint = {
			{ GLOSS_USB_ENDPOINT_OUT, LIBUSB_TRANSFER_TYPE_BULK, 512 },
			{ GLOSS_USB_ENDPOINT_IN, LIBUSB_TRANSFER_TYPE_BULK, 512 },
			{ GLOSS_USB_ENDPOINT_EVENT, LIBUSB_TRANSFER_TYPE_INTERRUPT, 8 },
		},
	};
}

static void state_start(uint64_t seed)
{
	fake.seed = seed;
	fake.held = false;
	fake.fail_at = 0;
	fake.fail_always = false;
	fake.bytes_in_flight = fake.memory_limit = 0;
	fake_list_init(&fake.ended);
	pthread_cond_init(&fake.changed, NULL);
}

void fake_usb_start(uint64_t seed)
{
	fake_usb = (struct fake_usb){ .calls = 0 };
	state_start(seed);
	fake_clock_start();
	for (unsigned int n = 0; n < FAKE_USB_BOARDS; n++) {
		board_default(&fake_usb.board[n]);
		fake_bridge_start(&fake.bridge[n], n);
	}
	memset(memory[0], (int)fake_below(256), sizeof(memory[0]));
	fake_usb_plug(0, false);
}

static void check_gone(const char *what, unsigned int count)
{
	if (count)
		fake_violation("%u %s left", count, what);
}

void fake_usb_stop(void)
{
	fake_clock_stop();
	check_gone("hotplug callbacks", fake_usb.hotplug_callbacks);
	check_gone("transfers", fake_usb.transfers);
	check_gone("handles", fake_usb.handles);
	check_gone("device lists", fake_usb.lists);
	check_gone("configuration descriptors", fake_usb.configurations);
	check_gone("devices", fake_usb.devices);
	check_gone("contexts", fake_usb.contexts);
	for (unsigned int n = 0; n < FAKE_USB_BOARDS; n++)
		fake_bridge_stop(&fake.bridge[n]);
	pthread_cond_destroy(&fake.changed);
}

/* ---- faults ---- */

const char *fake_usb_fault_name(enum fake_usb_fault fault)
{
	static const char *const name[FAKE_USB_FAULTS] = {
		"no fault",    "unplug",   "kill",           "glitch",       "bus reset",
		"stall OUT",   "stall IN", "stall event",    "error OUT",    "error IN",
		"overflow IN", "lose OUT", "lose IN",        "repeat IN",    "short IN",
		"empty IN",    "odd IN",   "garbage IN",     "garbage OUT",  "garbage event",
		"hang IN",     "hang OUT", "refuse control", "hang control", "reset lasts",
		"delay",
	};

	return name[fault];
}

void fake_usb_arm(unsigned int board, enum fake_usb_fault fault, uint64_t at, uint32_t value)
{
	struct fake_bridge *bridge = &fake.bridge[board];

	fake_lock();
	bridge->at[fault] = at;
	bridge->value[fault] = value;
	if (fault == FAKE_USB_GARBAGE_EVENT)
		bridge->garbage_event = true;
	if (fault == FAKE_USB_DELAY || fault == FAKE_USB_GARBAGE_EVENT)
		fake_usb.fired++;
	pthread_cond_broadcast(&fake.changed);
	fake_unlock();
}

void fake_usb_disarm(void)
{
	fake_lock();
	fake.fail_at = 0;
	fake.fail_always = false;
	for (struct fake_bridge *b = fake.bridge; b < fake.bridge + FAKE_USB_BOARDS; b++) {
		memset(b->at, 0, sizeof(b->at));
		memset(b->value, 0, sizeof(b->value));
		b->garbage_in = b->garbage_out = b->refusals = b->silences = b->resets_last = 0;
		b->empties = 0;
		b->hang_in = b->hang_out = b->garbage_event = false;
	}
	pthread_cond_broadcast(&fake.changed);
	fake_unlock();
}

unsigned int fake_usb_fired(void)
{
	unsigned int fired;

	fake_lock();
	fired = fake_usb.fired;
	fake_unlock();
	return fired;
}

void fake_usb_fail(const char *function, unsigned int at, int error)
{
	fake_lock();
	fake.fail_function = function;
	fake.fail_at = at;
	fake.fail_error = error;
	fake_unlock();
}

void fake_usb_fail_always(const char *function, int error)
{
	fake_lock();
	fake.fail_function = function;
	fake.fail_always = true;
	fake.fail_error = error;
	fake_unlock();
}

void fake_usb_limit_memory(size_t bytes)
{
	fake_lock();
	fake.memory_limit = bytes;
	fake_unlock();
}

unsigned int fake_usb_bulk_submits(void)
{
	unsigned int submits;

	fake_lock();
	submits = fake_usb.submits - fake_usb.control_submits;
	fake_unlock();
	return submits;
}

unsigned int fake_usb_take_depth_in(void)
{
	unsigned int depth;

	fake_lock();
	depth = fake_usb.depth_in;
	fake_usb.depth_in = 0;
	fake_unlock();
	return depth;
}

/* ---- the cable, and the boards ---- */

void fake_usb_unplug(unsigned int board)
{
	fake_lock();
	fake_bridge_unplug(&fake.bridge[board]);
	fake_unlock();
}

void fake_usb_plug(unsigned int board, bool power)
{
	fake_lock();
	if (power)
		memset(memory[board], (int)fake_below(256), sizeof(memory[board]));
	fake_bridge_plug(&fake.bridge[board], power);
	fake_unlock();
}

void fake_usb_kill(void)
{
	fake_lock();
	fake_device_kill();
	fake_unlock();
}

static void set_held(bool held)
{
	fake_lock();
	fake.held = held;
	fake_clock_stand(held);
	pthread_cond_broadcast(&fake.changed);
	fake_unlock();
}

void fake_usb_hold(void)
{
	set_held(true);
}

void fake_usb_release(void)
{
	set_held(false);
}

uint8_t *fake_usb_memory(unsigned int board)
{
	return memory[board];
}
