/* SPDX-License-Identifier: MIT */
#include "usb_fault.h"

#include "accel_test.h"

/* 1 to 2^@bits, small ones as often as large ones. */
static uint64_t any_size(uint64_t *seed, uint32_t bits)
{
	uint32_t most = test_below(seed, bits + 1);

	return 1 + test_random(seed) % (1ull << most);
}

const char *usb_fault_name(int kind)
{
	return kind == USB_FAULT_CALL ? "error of a call" :
					fake_usb_fault_name((enum fake_usb_fault)kind);
}

/* What @at counts: words, packets, or transfers and calls. */
static uint32_t fault_bits(int kind)
{
	switch (kind) {
	case FAKE_USB_GARBAGE_IN:
	case FAKE_USB_GARBAGE_OUT:
	case FAKE_USB_HANG_IN:
		return 15;
	case FAKE_USB_UNPLUG:
	case FAKE_USB_KILL:
	case FAKE_USB_GLITCH:
	case FAKE_USB_BUS_RESET:
	case FAKE_USB_HANG_OUT:
		return 10;
	case FAKE_USB_STALL_EVENT:
	case FAKE_USB_RESET_LASTS:
		return 0;
	case FAKE_USB_STALL_OUT:
	case FAKE_USB_ERROR_OUT:
	case FAKE_USB_LOSE_OUT:
		return 5;
	default:
		return 7;
	}
}

static uint32_t fault_value(int kind, uint64_t *seed)
{
	switch (kind) {
	case FAKE_USB_DELAY:
		return (uint32_t)any_size(seed, 22);
	case FAKE_USB_UNPLUG:
		return test_below(seed, 3);
	case FAKE_USB_RESET_LASTS:
		return (uint32_t)any_size(seed, 20);
	default:
		return (uint32_t)any_size(seed, 5) - 1;
	}
}

static struct usb_fault fault_choose(uint64_t *seed)
{
	struct usb_fault fault = { .kind = 1 + (int)test_below(seed, USB_FAULT_CALL) };

	fault.at = any_size(seed, fault_bits(fault.kind));
	fault.value = fault_value(fault.kind, seed);
	fault.error = -1 - (int)test_below(seed, 12);
	fault.early = test_below(seed, 4) == 0;
	/* Most requests are made while a board is opened. */
	if (fault.kind == FAKE_USB_RESET_LASTS ||
	    ((fault.kind == FAKE_USB_REFUSE_CONTROL || fault.kind == FAKE_USB_HANG_CONTROL) &&
	     test_below(seed, 4)))
		fault.early = true;
	return fault;
}

static void fault_arm(const struct usb_fault *fault)
{
	if (fault->kind == USB_FAULT_CALL)
		fake_usb_fail(NULL, (unsigned int)fault->at, fault->error);
	else
		fake_usb_arm(0, (enum fake_usb_fault)fault->kind, fault->at, fault->value);
}

bool usb_fault_harmless(const struct usb_fault *fault)
{
	return fault->kind == FAKE_USB_SHORT_IN || fault->kind == FAKE_USB_EMPTY_IN ||
	       (fault->kind == FAKE_USB_DELAY && fault->value < 500000) ||
	       (fault->kind == FAKE_USB_RESET_LASTS && fault->value < 500);
}

bool usb_fault_is_told(const struct usb_fault *fault)
{
	switch (fault->kind) {
	case FAKE_USB_UNPLUG:
	case FAKE_USB_KILL:
	case FAKE_USB_BUS_RESET:
	case FAKE_USB_STALL_OUT:
	case FAKE_USB_STALL_IN:
	case FAKE_USB_ERROR_OUT:
	case FAKE_USB_ERROR_IN:
	case FAKE_USB_OVERFLOW_IN:
		return true;
	case FAKE_USB_RESET_LASTS:
		return usb_fault_harmless(fault);
	case FAKE_USB_ODD_IN:
		/* In search of the sync, words are dropped, as are those that are none. */
		return !fault->early;
	default:
		return false;
	}
}

bool usb_fault_ends_host(const struct usb_fault *fault)
{
	return fault->kind == FAKE_USB_UNPLUG || fault->kind == FAKE_USB_KILL;
}

bool usb_fault_kills(const struct usb_fault *fault)
{
	return fault->kind == FAKE_USB_KILL;
}

bool usb_fault_delays(const struct usb_fault *fault)
{
	return fault->kind == FAKE_USB_DELAY;
}

struct usb_faults usb_faults_choose(uint64_t *seed)
{
	struct usb_faults faults = { .fault[0] = fault_choose(seed), .count = 1 };

	if (test_below(seed, 5) == 0)
		faults.fault[faults.count++] = fault_choose(seed);
	return faults;
}

static int faults_count(const struct usb_faults *faults, bool (*is)(const struct usb_fault *fault))
{
	int count = 0;

	for (int n = 0; n < faults->count; n++)
		count += is(&faults->fault[n]);
	return count;
}

bool usb_faults_any(const struct usb_faults *faults, bool (*is)(const struct usb_fault *fault))
{
	return faults_count(faults, is);
}

bool usb_faults_all(const struct usb_faults *faults, bool (*is)(const struct usb_fault *fault))
{
	return faults_count(faults, is) == faults->count;
}

void usb_faults_arm(const struct usb_faults *faults, bool early)
{
	for (int n = 0; n < faults->count; n++)
		if (faults->fault[n].early == early)
			fault_arm(&faults->fault[n]);
}
