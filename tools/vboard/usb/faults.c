// SPDX-License-Identifier: MIT
#include "vboard/usb/faults.h"

#include <stddef.h>

#include "gloss_packets.h"
#include "gloss_regs.h"
#include "vboard/loop.h"

#define NOISE_WORDS 16

/* Counts down; true: this is the one. */
static bool faults_hit(uint32_t *count)
{
	if (!*count)
		return false;
	return !--*count;
}

void vboard_usb_faults_init(struct vboard_usb_faults *faults,
			    const struct vboard_usb_faults_armed *armed)
{
	*faults = (struct vboard_usb_faults){ .armed = *armed, .random = 1 };
}

/* ---- transfers ---- */

bool vboard_usb_faults_unplug(struct vboard_usb_faults *faults)
{
	return faults->armed.unplug != VBOARD_USB_FAULT_UNPLUG_NOW &&
	       faults_hit(&faults->armed.unplug);
}

bool vboard_usb_faults_exit(struct vboard_usb_faults *faults)
{
	return faults_hit(&faults->armed.exit);
}

enum vboard_usb_fault vboard_usb_faults_out(struct vboard_usb_faults *faults)
{
	bool stall = faults_hit(&faults->armed.stall_out);
	bool lose = faults_hit(&faults->armed.lose_out);

	return stall ? VBOARD_USB_STALL : lose ? VBOARD_USB_LOSE : VBOARD_USB_FAULT_NONE;
}

enum vboard_usb_fault vboard_usb_faults_in(struct vboard_usb_faults *faults, uint32_t words)
{
	if (faults_hit(&faults->armed.stall_in))
		return VBOARD_USB_STALL;
	if (faults->armed.empty_in) {
		faults->armed.empty_in--;
		return VBOARD_USB_EMPTY;
	}
	/* One word has no half, so its fault is that of the next one. */
	if (words > 1 && faults_hit(&faults->armed.short_in))
		return VBOARD_USB_SHORT;
	return VBOARD_USB_FAULT_NONE;
}

bool vboard_usb_faults_refuse(struct vboard_usb_faults *faults)
{
	return faults_hit(&faults->armed.refuse_control);
}

/* ---- words of IN ---- */

/* xorshift32 */
static uint32_t faults_random(struct vboard_usb_faults *faults)
{
	faults->random ^= faults->random << 13;
	faults->random ^= faults->random >> 17;
	faults->random ^= faults->random << 5;
	return faults->random;
}

static void faults_garble(struct vboard_usb_faults *faults, uint32_t *words, uint32_t count)
{
	uint32_t at = 0;

	if (faults->armed.garbage > count) {
		faults->armed.garbage -= count;
	} else if (faults->armed.garbage) {
		at = faults->armed.garbage - 1;
		faults->armed.garbage = 0;
		faults->noise = NOISE_WORDS;
	}
	for (; at < count && faults->noise; faults->noise--)
		words[at++] = faults_random(faults);
}

/* A message begins with @head; true: it does not leave yet. */
static bool faults_begin(struct vboard_usb_faults *faults, uint32_t head)
{
	struct gloss_usb_response message;

	gloss_usb_response_unpack(&head, &message);
	if (message.mark == GLOSS_USB_RESPONSE_MAGIC) {
		faults->left = GLOSS_USB_RESPONSE_WORDS + message.count;
		return false;
	}
	if (message.mark != GLOSS_USB_COMPLETION_MAGIC) {
		faults->left = GLOSS_USB_SYNC_WORDS;
		return false;
	}
	faults->left = GLOSS_USB_COMPLETION_WORDS;
	if (faults_hit(&faults->armed.hang))
		faults->hung = true;
	else if (faults->armed.delay)
		faults->due = vboard_now() + 1000ull * faults->armed.delay;
	else
		faults->jobs++;
	return faults->hung || faults->due;
}

uint32_t vboard_usb_faults_words(struct vboard_usb_faults *faults, uint32_t *words, uint32_t count)
{
	uint32_t at = 0, may = count;

	while (at < count) {
		uint32_t step = count - at;

		if (!faults->left && faults_begin(faults, words[at]))
			may = at;
		if (step > faults->left)
			step = faults->left;
		faults->left -= step;
		at += step;
	}
	if (faults->armed.garbage || faults->noise)
		faults_garble(faults, words, count);
	return may;
}

bool vboard_usb_faults_hold(struct vboard_usb_faults *faults)
{
	if (faults->hung)
		return true;
	if (!faults->due)
		return false;
	if (vboard_now() < faults->due)
		return true;
	faults->due = 0;
	faults->jobs++;
	return false;
}

uint64_t vboard_usb_faults_due(const struct vboard_usb_faults *faults)
{
	return faults->due && !faults->hung ? faults->due : UINT64_MAX;
}

void vboard_usb_faults_reset(struct vboard_usb_faults *faults)
{
	faults->left = 0;
	faults->hung = false;
	faults->due = 0;
	faults->noise = 0;
}

/* ---- the window ---- */

/* The register that can be armed at @offset; NULL: there is none. */
static uint32_t *faults_register(struct vboard_usb_faults_armed *armed, uint32_t offset)
{
	switch (offset) {
	case VBOARD_USB_FAULT_UNPLUG:
		return &armed->unplug;
	case VBOARD_USB_FAULT_REPLUG:
		return &armed->replug;
	case VBOARD_USB_FAULT_STALL_OUT:
		return &armed->stall_out;
	case VBOARD_USB_FAULT_STALL_IN:
		return &armed->stall_in;
	case VBOARD_USB_FAULT_SHORT_IN:
		return &armed->short_in;
	case VBOARD_USB_FAULT_EMPTY_IN:
		return &armed->empty_in;
	case VBOARD_USB_FAULT_DELAY:
		return &armed->delay;
	case VBOARD_USB_FAULT_GARBAGE:
		return &armed->garbage;
	case VBOARD_USB_FAULT_HANG:
		return &armed->hang;
	case VBOARD_USB_FAULT_LOSE_OUT:
		return &armed->lose_out;
	case VBOARD_USB_FAULT_EXIT:
		return &armed->exit;
	case VBOARD_USB_FAULT_REFUSE_CONTROL:
		return &armed->refuse_control;
	default:
		return NULL;
	}
}

uint32_t vboard_usb_faults_window_read(const struct vboard_usb_faults *faults, uint32_t offset)
{
	struct vboard_usb_faults_armed armed = faults->armed;
	const uint32_t *value = faults_register(&armed, offset);

	if (offset == VBOARD_USB_FAULT_IDENTITY)
		return VBOARD_USB_FAULT_IDENTITY_VALUE;
	if (offset == VBOARD_USB_FAULT_JOBS)
		return faults->jobs;
	return value ? *value : 0;
}

void vboard_usb_faults_window_write(struct vboard_usb_faults *faults, uint32_t offset,
				    uint32_t value)
{
	uint32_t *armed = faults_register(&faults->armed, offset);

	if (!armed)
		return;
	*armed = value;
	if (armed == &faults->armed.hang && faults->hung) {
		faults->hung = false;
		faults->jobs++;
	}
}
