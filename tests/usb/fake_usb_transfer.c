/* SPDX-License-Identifier: MIT */
/* Transfers from their making to their callback, and who calls it. */
#include <sanitizer/asan_interface.h>
#include <stdlib.h>
#include <string.h>
#include <sys/time.h>

#include "fake_usb_priv.h"

#define NS_PER_US 1000ll
#define NS_PER_MS 1000000ll
#define NS_PER_S 1000000000ll

static struct fake_transfer transfers[FAKE_TRANSFERS];
static unsigned int last_made;

/* ---- lists ---- */

void fake_list_init(struct fake_list *list)
{
	list->first = NULL;
	list->last = &list->first;
}

static void list_append(struct fake_list *list, struct fake_transfer *transfer)
{
	transfer->next = NULL;
	*list->last = transfer;
	list->last = &transfer->next;
}

static void list_remove(struct fake_list *list, struct fake_transfer *transfer)
{
	struct fake_transfer **link = &list->first;

	while (*link != transfer)
		link = &(*link)->next;
	*link = transfer->next;
	if (!*link)
		list->last = link;
}

/* ---- making ---- */

/* As from calloc; one that was freed is not used again soon, and not to be touched. */
struct libusb_transfer *fake_transfer_new(void)
{
	struct fake_transfer *transfer;
	unsigned int tried = 0;

	do {
		transfer = &transfers[++last_made % FAKE_TRANSFERS];
	} while (transfer->state != FAKE_FREE && tried++ < FAKE_TRANSFERS);
	if (transfer->state != FAKE_FREE)
		fake_violation("too many transfers");
	ASAN_UNPOISON_MEMORY_REGION(transfer, sizeof(*transfer));
	memset(transfer, 0, sizeof(*transfer));
	transfer->state = FAKE_IDLE;
	return &transfer->public;
}

static struct fake_transfer *transfer_check(struct libusb_transfer *public, const char *function)
{
	struct fake_transfer *transfer = (void *)((uint8_t *)public -
						  offsetof(struct fake_transfer, public));

	if (transfer < transfers || transfer >= transfers + FAKE_TRANSFERS ||
	    transfer->state == FAKE_FREE)
		fake_violation("%s: the transfer is gone", function);
	return transfer;
}

void fake_transfer_delete(struct libusb_transfer *public)
{
	struct fake_transfer *transfer = transfer_check(public, "libusb_free_transfer");

	if (transfer->state != FAKE_IDLE)
		fake_violation("a transfer is freed in flight");
	if (public->flags & LIBUSB_TRANSFER_FREE_BUFFER)
		free(public->buffer);
	memset(public, 0xa5, sizeof(*public));
	transfer->state = FAKE_FREE;
	ASAN_POISON_MEMORY_REGION(public, sizeof(*public));
}

struct libusb_transfer *libusb_alloc_transfer(int iso_packets)
{
	struct libusb_transfer *public = NULL;

	if (iso_packets)
		fake_violation("%s: there is no isochronous endpoint", __func__);
	fake_lock();
	if (!fake_call(__func__)) {
		public = fake_transfer_new();
		fake_usb.transfers++;
	}
	fake_unlock();
	return public;
}

void libusb_free_transfer(struct libusb_transfer *public)
{
	if (!public)
		return;
	fake_lock();
	fake_transfer_delete(public);
	fake_usb.transfers--;
	fake_unlock();
}

/* ---- submitting and cancelling ---- */

/* What is not in the configuration is not to be spoken to. */
static bool has_endpoint(const struct libusb_transfer *public)
{
	const struct fake_usb_board *board = fake_device_board(public->dev_handle->device);

	for (unsigned int n = 0; n < board->endpoints; n++)
		if (board->endpoint[n].address == public->endpoint &&
		    (board->endpoint[n].attributes & LIBUSB_TRANSFER_TYPE_MASK) == public->type)
			return true;
	return false;
}

static enum fake_queue transfer_queue(const struct libusb_transfer *public, const char *function)
{
	const bool bulk = public->type == LIBUSB_TRANSFER_TYPE_BULK && has_endpoint(public);

	if (public->type == LIBUSB_TRANSFER_TYPE_CONTROL)
		return FAKE_CONTROL;
	if (bulk && public->endpoint == GLOSS_USB_ENDPOINT_OUT)
		return FAKE_OUT;
	if (bulk && public->endpoint == GLOSS_USB_ENDPOINT_IN)
		return FAKE_IN;
	if (public->type == LIBUSB_TRANSFER_TYPE_INTERRUPT && has_endpoint(public) &&
	    public->endpoint == GLOSS_USB_ENDPOINT_EVENT)
		return FAKE_EVENT;
	fake_violation("%s: no endpoint %02x of type %u", function, public->endpoint, public->type);
}

/* Linux claims an interface for who forgot to, and says so in the kernel's log. */
static void check_claim(struct fake_transfer *transfer, const char *function)
{
	const uint8_t *setup = transfer->public.buffer;
	unsigned int interface = 0;

	if (transfer->queue == FAKE_CONTROL) {
		if ((setup[0] & 0x1f) != LIBUSB_RECIPIENT_INTERFACE)
			return;
		interface = setup[4];
	}
	if (interface < FAKE_INTERFACES)
		fake_handle_use(transfer->handle, interface, function);
}

/* The kernel has a copy of each, and a bound for all of them. */
static bool has_memory(const struct libusb_transfer *public)
{
	return !fake.memory_limit ||
	       fake.bytes_in_flight + (size_t)(public->length) <= fake.memory_limit;
}

static void count_depth(const struct fake_list *list, unsigned int *most)
{
	unsigned int depth = 0;

	for (const struct fake_transfer *t = list->first; t; t = t->next)
		depth++;
	if (depth > *most)
		*most = depth;
}

int fake_transfer_submit(struct libusb_transfer *public, const char *function)
{
	struct fake_transfer *transfer = transfer_check(public, function);
	struct fake_bridge *bridge;

	if (transfer->state != FAKE_IDLE)
		fake_violation("%s: the transfer is in flight", function);
	fake_handle_check(public->dev_handle, function);
	if (public->length < 0 || (public->length && !public->buffer) || !public->callback)
		fake_violation("%s: the transfer is not filled in", function);
	if (!fake_handle_alive(public->dev_handle))
		return LIBUSB_ERROR_NO_DEVICE;
	transfer->queue = transfer_queue(public, function);
	transfer->handle = public->dev_handle;
	check_claim(transfer, function);
	if (!has_memory(public)) {
		fake_usb.fired++;
		return LIBUSB_ERROR_NO_MEM;
	}
	fake.bytes_in_flight += (size_t)(public->length);
	public->actual_length = 0;
	transfer->cancelled = transfer->lost = false;
	transfer->deadline = public->timeout ? fake_usb_now_ns() + public->timeout * NS_PER_MS :
					       INT64_MAX;
	transfer->state = FAKE_QUEUED;
	bridge = fake_handle_bridge(public->dev_handle);
	list_append(&bridge->queue[transfer->queue], transfer);
	fake_usb.submits++;
	fake_usb.control_submits += transfer->queue == FAKE_CONTROL;
	fake_usb.in_flight++;
	count_depth(&bridge->queue[FAKE_OUT], &fake_usb.depth_out);
	count_depth(&bridge->queue[FAKE_IN], &fake_usb.depth_in);
	pthread_cond_broadcast(&fake.changed);
	return 0;
}

int libusb_submit_transfer(struct libusb_transfer *public)
{
	int err;

	fake_lock();
	err = fake_call(__func__);
	if (!err)
		err = fake_transfer_submit(public, __func__);
	fake_unlock();
	return err;
}

int libusb_cancel_transfer(struct libusb_transfer *public)
{
	struct fake_transfer *transfer;
	int err;

	fake_lock();
	transfer = transfer_check(public, __func__);
	err = fake_call(__func__);
	if (!err && (transfer->state == FAKE_IDLE || transfer->cancelled))
		err = LIBUSB_ERROR_NOT_FOUND;
	if (!err && !fake_handle_alive(transfer->handle))
		err = LIBUSB_ERROR_NO_DEVICE;
	/* It may have ended before, or do so meanwhile: then it was not cancelled. */
	if (!err) {
		transfer->cancelled = true;
		pthread_cond_broadcast(&fake.changed);
	}
	fake_unlock();
	return err;
}

/* ---- ending ---- */

void fake_transfer_end(struct fake_transfer *transfer, enum libusb_transfer_status status)
{
	struct fake_bridge *bridge = fake_handle_bridge(transfer->handle);

	list_remove(&bridge->queue[transfer->queue], transfer);
	transfer->public.status = status;
	transfer->state = FAKE_ENDED;
	transfer->due = fake_usb_now_ns() + bridge->value[FAKE_USB_DELAY] * NS_PER_US;
	list_append(&fake.ended, transfer);
	pthread_cond_broadcast(&fake.changed);
}

void fake_transfer_end_all(struct fake_bridge *bridge, const struct libusb_device_handle *handle,
			   enum libusb_transfer_status status)
{
	struct fake_transfer *transfer, *next;

	for (int queue = 0; queue < FAKE_QUEUES; queue++)
		for (transfer = bridge->queue[queue].first; transfer; transfer = next) {
			next = transfer->next;
			if (!handle || transfer->handle == handle)
				fake_transfer_end(transfer, status);
		}
}

/* ---- events ---- */

/* Without the lock while in the callback. */
static void transfer_call(struct fake_transfer *transfer)
{
	struct libusb_transfer *public = &transfer->public;
	uint8_t flags = public->flags;

	list_remove(&fake.ended, transfer);
	transfer->state = FAKE_IDLE;
	fake.bytes_in_flight -= (size_t)(public->length);
	fake_usb.in_flight--;
	fake_usb.callbacks++;
	if (flags & LIBUSB_TRANSFER_SHORT_NOT_OK)
		fake_violation("SHORT_NOT_OK is not looked at here");
	fake_unlock();
	public->callback(public);
	if (flags & LIBUSB_TRANSFER_FREE_TRANSFER)
		libusb_free_transfer(public);
	fake_lock();
}

/* Of those that are due; the order of callbacks is not promised. */
static struct fake_transfer *ended_any(const struct libusb_context *context, int64_t now)
{
	struct fake_transfer *transfer, *any = NULL;

	for (transfer = fake.ended.first; transfer; transfer = transfer->next)
		if (transfer->handle->device->context == context && transfer->due <= now &&
		    (!any || !fake_below(4)))
			any = transfer;
	return any;
}

/* Some of those that are due, or all. False: none is. */
static bool dispatch(struct libusb_context *context)
{
	int64_t now = fake_usb_now_ns();
	struct fake_transfer *transfer = ended_any(context, now);
	bool any = fake_device_announce(context);

	while (transfer) {
		transfer_call(transfer);
		any = true;
		transfer = fake_below(8) ? ended_any(context, now) : NULL;
	}
	return any;
}

/* Ends what waits for too long; when the next of those would be. */
static int64_t time_out(void)
{
	int64_t now = fake_usb_now_ns(), next = INT64_MAX;
	struct fake_transfer *transfer, *after;

	for (struct fake_bridge *b = fake.bridge; b < fake.bridge + FAKE_USB_BOARDS; b++)
		for (int queue = 0; queue < FAKE_QUEUES; queue++)
			for (transfer = b->queue[queue].first; transfer; transfer = after) {
				after = transfer->next;
				if (transfer->deadline <= now)
					fake_transfer_end(transfer, LIBUSB_TRANSFER_TIMED_OUT);
				else if (transfer->deadline < next)
					next = transfer->deadline;
			}
	return next;
}

static int64_t next_due(void)
{
	int64_t due = INT64_MAX;

	for (struct fake_transfer *transfer = fake.ended.first; transfer; transfer = transfer->next)
		if (transfer->due < due)
			due = transfer->due;
	return due;
}

static bool is_completed(const int *completed)
{
	return completed && __atomic_load_n(completed, __ATOMIC_ACQUIRE);
}

/* As the one who calls this context's callbacks, until some were called. */
static void events_handle(struct libusb_context *context, int64_t deadline, const int *completed)
{
	context->handled = true;
	context->handler = pthread_self();
	while (!context->interrupted && !is_completed(completed)) {
		bool moved = fake_bridge_pump();
		int64_t next = time_out();

		if (dispatch(context) || fake_usb_now_ns() >= deadline)
			break;
		fake_clock_round();
		if (moved)
			fake_give_way();
		else
			fake_wait(next < deadline ? next : deadline, next_due());
	}
	context->interrupted = false;
	context->handled = false;
	pthread_cond_broadcast(&fake.changed);
}

static void events_wait(struct libusb_context *context, int64_t deadline, const int *completed)
{
	unsigned int callbacks = fake_usb.callbacks;

	while (context->handled && fake_usb.callbacks == callbacks && !is_completed(completed) &&
	       fake_usb_now_ns() < deadline)
		fake_wait(deadline, INT64_MAX);
}

int fake_events(struct libusb_context *context, int64_t timeout_ns, int *completed)
{
	int64_t deadline = fake_usb_now_ns() + timeout_ns;

	if (context->handled && pthread_equal(context->handler, pthread_self()))
		fake_violation("events are handled in a callback");
	if (!context->handled)
		events_handle(context, deadline, completed);
	else
		events_wait(context, deadline, completed);
	return 0;
}

int libusb_handle_events_timeout_completed(libusb_context *context, struct timeval *tv,
					   int *completed)
{
	int err;

	fake_lock();
	fake_context_check(context, __func__);
	if (tv->tv_sec < 0 || tv->tv_usec < 0 || tv->tv_usec >= 1000000)
		err = LIBUSB_ERROR_INVALID_PARAM;
	else
		err = fake_call("libusb_handle_events");
	if (!err)
		err = fake_events(context, tv->tv_sec * NS_PER_S + tv->tv_usec * NS_PER_US,
				  completed);
	fake_unlock();
	return err;
}

int libusb_handle_events_timeout(libusb_context *context, struct timeval *tv)
{
	return libusb_handle_events_timeout_completed(context, tv, NULL);
}

int libusb_handle_events_completed(libusb_context *context, int *completed)
{
	struct timeval minute = { 60, 0 };

	return libusb_handle_events_timeout_completed(context, &minute, completed);
}

int libusb_handle_events(libusb_context *context)
{
	return libusb_handle_events_completed(context, NULL);
}

void libusb_interrupt_event_handler(libusb_context *context)
{
	fake_lock();
	fake_context_check(context, __func__)->interrupted = true;
	pthread_cond_broadcast(&fake.changed);
	fake_unlock();
}
