/* SPDX-License-Identifier: MIT */
#include "usb_trial_priv.h"

#define ITEMS 4

static const char *context = "";

void usb_trial_context(const char *text)
{
	context = text;
}

void usb_trial_fail(const char *format, ...)
{
	va_list arguments;

	va_start(arguments, format);
	fprintf(stderr, "%s: ", context);
	vfprintf(stderr, format, arguments);
	fprintf(stderr, "\n");
	va_end(arguments);
	exit(1);
}

struct accel_device *usb_trial_model(unsigned int tile_size)
{
	struct accel_device *device;
	char name[64];

	snprintf(name, sizeof(name), "model:memory=8388608,tile=%u", tile_size);
	if (accel_device_new(name, NULL, NULL, &device))
		usb_trial_fail("%s does not open", name);
	return device;
}

void *trial_memory(size_t count, size_t size)
{
	void *block = calloc(count, size);

	if (!block)
		usb_trial_fail("out of memory");
	return block;
}

void trial_compare_words(const struct item *item, const char *what, const uint32_t *board,
			 const uint32_t *model, size_t count)
{
	for (size_t n = 0; n < count; n++)
		if (board[n] != model[n])
			usb_trial_fail("seed %#llx: word %zu of %s: board %08x, model %08x",
				       (unsigned long long)item->seed, n, what, board[n], model[n]);
}

/* On the board (@side 0) or the model. */
static int item_submit(struct item *item, int side, struct accel_device *device)
{
	switch (item->kind) {
	case ITEM_JOB:
		return trial_job_submit(item, &item->job[side], device);
	case ITEM_PICTURE:
		return trial_picture_submit(item, &item->drawn[side], device);
	default:
		return side ? 0 : trial_copy_submit(&item->copy, device);
	}
}

static int item_finish(struct item *item, int side)
{
	switch (item->kind) {
	case ITEM_JOB:
		return trial_job_finish(&item->job[side]);
	case ITEM_PICTURE:
		return trial_picture_finish(item, &item->drawn[side]);
	default:
		return side ? 0 : trial_copy_finish(&item->copy);
	}
}

static void item_compare(const struct item *item)
{
	switch (item->kind) {
	case ITEM_JOB:
		trial_job_compare(item);
		break;
	case ITEM_PICTURE:
		trial_picture_compare(item);
		break;
	default:
		trial_copy_compare(item);
	}
}

static void item_prepare(struct item *item, uint64_t *seed, unsigned int tile_size)
{
	static const enum item_kind kind[] = {
		ITEM_JOB, ITEM_JOB, ITEM_JOB, ITEM_JOB, ITEM_PICTURE, ITEM_PICTURE, ITEM_COPY,
	};

	*item = (struct item){ .seed = test_random(seed), .kind = kind[test_below(seed, 7)] };
	if (item->kind == ITEM_JOB)
		trial_job_prepare(item, tile_size);
	else if (item->kind == ITEM_PICTURE)
		trial_picture_prepare(item);
	else
		trial_copy_prepare(item);
}

static void item_free(struct item *item)
{
	for (int n = 0; n < 2; n++) {
		free(item->job[n].response);
		free(item->job[n].content);
		free(item->drawn[n].pixel);
	}
	free(item->copy.sent);
	free(item->copy.back);
}

static int items_run(struct item *items, int count, int side, struct accel_device *device)
{
	int err = 0, last;

	for (int n = 0; n < count && !err; n++)
		err = item_submit(&items[n], side, device);
	for (int n = 0; n < count; n++) {
		last = item_finish(&items[n], side);
		if (!err)
			err = last;
	}
	return err;
}

static void check_error(int err)
{
	if (err && err != -EIO && err != -ENODEV && err != -ENOMEM)
		usb_trial_fail("the error %s is none that a board may have", strerror(-err));
}

int usb_trial_run(struct accel_device *device, struct accel_device *model, uint64_t seed)
{
	struct item *items = trial_memory(ITEMS, sizeof(*items));
	int count = 1 + (int)test_below(&seed, ITEMS), err;
	struct accel_device_info info;

	accel_device_info(device, &info, sizeof(info));
	for (int n = 0; n < count; n++)
		item_prepare(&items[n], &seed, info.tile_size);
	err = items_run(items, count, 0, device);
	check_error(err);
	if (items_run(items, count, 1, model))
		usb_trial_fail("the model failed");
	for (int n = 0; n < count; n++)
		item_compare(&items[n]);
	for (int n = 0; n < count; n++)
		item_free(&items[n]);
	free(items);
	return err;
}
