/* SPDX-License-Identifier: MIT */
/*
 * libaccel: draws on a Gloss board.
 *
 * Two levels share devices, buffers and fences. At the draw level a program hands
 * over meshes, matrices, lights and materials, and the library transforms, lights,
 * chooses the shading of each triangle, bins triangles to tiles and packs the
 * command stream; its functions are in accel_draw.h, which this includes. At the
 * stream level a program packs its own (packets are in gloss_packets.h, their
 * meaning in rtl/INTERFACE.md). What is said here is true of both.
 *
 * Errors. Functions return 0 or a positive count, or a negative errno value;
 * a message saying what failed goes to the device's message function if there
 * is one. The library does not print, exit or abort. Any function that takes
 * memory may return -ENOMEM, and any that talks to the board -EIO (the board
 * refused or failed) and -ENODEV (it is gone). A call that fails has no effect,
 * unless its comment says otherwise. Pointers must not be NULL unless stated.
 *
 * Threads. A device may be used by any number of threads at once. Every other
 * object is to be used by one thread at a time; different objects, also of one
 * device, by different threads at once. No call is a cancellation point: a thread
 * that is cancelled (deferred, as is the default) ends after the call.
 *
 * Waiting. These calls wait until jobs have ended: accel_fence_wait and
 * accel_fence_free, all that read or write a buffer or a target, those called _finish, and
 * the call that frees a device's last object. accel_stream_submit and accel_draw_submit
 * wait while the board's queue is full. These wait for an answer of the board itself, for
 * seconds at most: accel_device_new, accel_device_list, accel_device_clocks, and the call
 * that frees a device's last object. No other call waits for a board, or for a thread that
 * does.
 *
 * Processes. After fork() a device and its objects belong to the parent alone. In the
 * child each call that needs the board returns -ENODEV at once. A _free in the child
 * frees the object's own memory and waits for nothing. It leaves alone board memory,
 * jobs, the claim of a board, its file descriptors, and the child's copy of what the
 * device has in memory; these go when the child ends or calls exec. A child that wants
 * to draw opens a device of its own. As long as a child lives it may keep a board on
 * USB busy, even after its parent was killed. dlclose() does not unload the library,
 * because its threads may still run.
 *
 * Environment. With ACCEL_DUMP=FOLDER, accel_draw_submit and accel_stream_submit write
 * each job to files in that folder before they send it, for gloss-decode(1). They then
 * wait for the jobs before it. A file that cannot be written is a message, not an error.
 * GLOSS_SIM_PATH=FOLDER is where "sim:" looks for its plugin first. A program that runs
 * with more rights than its user ignores both.
 *
 * Structs. Those that begin with a member @size grow in later versions. A program sets it
 * to the size that it was compiled with, as ACCEL_LIGHT() and its like do. Members that are
 * not named, or came later than the program, are zero, which is their default. -E2BIG: the
 * program is newer than the library, and members that the library does not know are not
 * zero. -EINVAL: @size is not set. Structs that the library fills are followed by their size
 * in the call: it writes no more bytes than that, and zero to those that it does not know.
 * All other structs stay as they are.
 *
 * Ownership. Every _new has its _free, which takes NULL. An object keeps alive what
 * it was made from and what it refers to: a device that is freed before its buffers
 * goes with the last of them, and a buffer that a stream or a running job names goes
 * when that has done with it.
 *
 * Units. Matrices are 4x4 floats, column by column, as in OpenGL; a vector is a
 * column. Clip space is OpenGL's (-w <= x, y, z <= w), window y points down in
 * memory and on screen: NDC y = 1 is row 0. Colours are floats, 0 to 1.
 */
#ifndef ACCEL_H
#define ACCEL_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The version that a program is compiled with; accel_version() is that of the library it finds. */
#define ACCEL_VERSION_MAJOR 0
#define ACCEL_VERSION_MINOR 1
#define ACCEL_VERSION_PATCH 0

/*
 * The initialiser of a struct with a size. In C it has the members that are not zero:
 *
 *	struct accel_light lamp = ACCEL_LIGHT(.enabled = true, .diffuse = { 1, 1, 1, 1 });
 *
 * In C++ it has none, and they are set after that: accel_light lamp = ACCEL_LIGHT();
 */
/* clang-format off */
#ifdef __cplusplus
extern "C++" {
template <typename type> inline type accel_sized()
{
	type zero = type();

	zero.size = sizeof(type);
	return zero;
}
}
#define ACCEL_SIZED(type, ...) accel_sized<struct type>(__VA_ARGS__)
#else
#define ACCEL_SIZED(type, ...) { .size = sizeof(struct type), __VA_ARGS__ }
#endif
/* clang-format on */

struct accel_device;
struct accel_buffer;
struct accel_stream;
struct accel_fence;

/* "0.1.0": of the library that runs. The string is the library's, for ever. */
const char *accel_version(void);

/* ---- device ---- */

struct accel_device_info {
	char name[64];      /* for people */
	uint32_t tile_size; /* pixels, 32 or 64 */
	uint32_t pixels_per_clock;
	uint64_t memory_size; /* bytes */
};

/*
 * Receives one line without a newline, which is lent for the call. Called from the
 * thread of the failing call, so perhaps from several at once; it may call the library.
 */
typedef void (*accel_message_fn)(void *data, const char *message);

/*
 * A ready accel_message_fn: prints @line and a newline to @file, which is a FILE * of stdio.h,
 * or NULL for stderr. Any number of threads may call it at once, and lines do not mix.
 */
void accel_message_print(void *file, const char *line);

/*
 * Receives one device: the name that accel_device_new takes for it, and a line for people
 * without a newline, which says what it is or why it would not open. Both are lent for the
 * call. What a board says of itself is in them as printable ASCII, the rest as "?".
 */
typedef void (*accel_device_list_fn)(void *data, const char *name, const char *line);

/*
 * Calls @found with each device there is, in the order in which "auto" tries them. Boards
 * that would not open are listed too, because another program has them or this one has no
 * permission. No board is disturbed in what it does. @found is called from this thread and
 * may call the library, which does not change what is listed after it.
 * Returns 0 also when there is no device. -ENOMEM: some devices may have been listed.
 */
int accel_device_list(accel_device_list_fn found, void *data);

/*
 * Opens the board called @name: "drm:" (a PCI board, through the kernel module gloss),
 * "usb:" (a board on USB, through libusb), "model:" (the C model, in this process),
 * "sim:" (the Verilated RTL, in this process) or "auto" (the first of these that opens).
 * NULL means "auto". The colon may be left out if nothing follows.
 *
 * "drm:" is the first render node of a Gloss board that opens, "drm:/dev/dri/renderD128"
 * that node.
 *
 * "usb:" is the first Gloss board on USB that opens. "usb:1209:0001/SERIAL" is the board with
 * these ids and that serial number; of several with the same, the first that opens. "/SERIAL"
 * may be left out, and so may the ids if they are these. "usb:1-2.3" is the board at bus 1,
 * port 3 of the hub at its port 2: accel_device_list gives such names to boards that share a
 * serial number. One program at a time has a board on USB.
 *
 * When the cable fails, the jobs that had not ended fail with -EIO. The board is started again
 * and the next job runs as usual. Buffers keep their content, except where those jobs were to
 * write. If words of a job were garbled on their way, which USB nearly always prevents, any
 * buffer of the device may have been overwritten; nothing says which. A board that fails sixteen
 * times in a row without doing a job counts as gone. When the kernel has no memory for USB
 * transfers, jobs fail with -ENOMEM, and later ones may succeed. When the board is unplugged, or
 * has lost its power and with it what its buffers held, all jobs fail with -ENODEV from then on:
 * open it again as another device.
 *
 * Options of "model:" and "sim:" follow the colon, separated by commas:
 *
 *   tile=32 or 64	pixels of a tile's side; 64 if not given
 *   lanes=1, 2, 4, 8	pixels a clock, "sim:" only; 8 if not given
 *   memory=BYTES	board memory, a multiple of 4096 up to 2^32; 256 MiB if not given
 *   threads=N	that set up meshes and that draw tiles, 1 to 64, "model:" only; as many as
 *			there are processors if not given, and for meshes on all other devices. They
 *			make no difference but in time, and are started when there is work for them.
 *   stalls=SEED	"sim:" only: its ports stall at random; never if 0, the default
 *
 * The plugin of "sim:" is looked for in the directory $GLOSS_SIM_PATH, then in
 * sim/ beside the library, then where `make install` puts it.
 * @message may be NULL; it and @data must last as long as the device.
 * -ENODEV: there is no such board. -ENOSYS: its support is not installed or does not load.
 * -EACCES: not permitted. -EBUSY: another program or a driver of the kernel has it. -EINVAL: the
 * name or an option is not understood. -ENOMEM: also when the kernel has no memory for USB
 * transfers. The message says what to do. "auto" gives no message for boards that are not there.
 */
int accel_device_new(const char *name, accel_message_fn message, void *data,
		     struct accel_device **device);
/* The device goes with the last object that is of it, and waits for its jobs then. */
void accel_device_free(struct accel_device *device);
/* Fills @info, of which the caller has @size bytes: sizeof(*info). */
void accel_device_info(struct accel_device *device, struct accel_device_info *info, size_t size);

/* Where the board's clocks went, summed over all jobs that have ended since the device was
 * opened. */
struct accel_device_clocks {
	uint64_t clocks;         /* in which the board had a job */
	uint64_t stall_stream;   /* command waited for stream words */
	uint64_t stall_raster;   /* a triangle waited for raster */
	uint64_t stall_tile;     /* triangles waited for a tile buffer */
	uint64_t stall_memory;   /* command or a tile waited for board memory */
	uint64_t stall_response; /* the response waited for the host */
};

/*
 * Fills @clocks, of which the caller has @size bytes: sizeof(*clocks). An error leaves them alone.
 * -ENOTSUP: the board, such as "model:", does not count clocks. -EIO: it did not answer.
 * -ENODEV.
 */
int accel_device_clocks(struct accel_device *device, struct accel_device_clocks *clocks,
			size_t size);

/*
 * Waits until all jobs have ended that were submitted before, by any thread. Returns what
 * accel_fence_wait would for the first that failed of the jobs that were submitted without a
 * fence since the last call; of other jobs their fences tell.
 * -EIO, -ETIME, -ENODEV, -ENOMEM.
 */
int accel_device_finish(struct accel_device *device);

/* ---- buffer: a range of board memory ---- */

/*
 * @size is in bytes, a multiple of 4 from 4 to 2^31. The buffer's content is zero.
 * -EINVAL: another @size. -ENOMEM: also when board memory has no such range left.
 */
int accel_buffer_new(struct accel_device *device, uint64_t size, struct accel_buffer **buffer);
/* Does not wait: the memory is given back when no stream and no job uses it any more. */
void accel_buffer_free(struct accel_buffer *buffer);

/*
 * Copies @size bytes between @data and the buffer, from its byte @offset on, after all
 * jobs that were submitted before. On return the copy is complete. @offset and @size
 * are multiples of 4; a @size of 0 does nothing. Words are in the host's byte order.
 * After an error other than -EINVAL a part may have been copied.
 * -EINVAL: not a multiple of 4, or outside the buffer. -EIO, -ENODEV.
 */
int accel_buffer_write(struct accel_buffer *buffer, uint64_t offset, const void *data,
		       uint64_t size);
int accel_buffer_read(struct accel_buffer *buffer, uint64_t offset, void *data, uint64_t size);

/* ---- stream: your own packets ---- */

#define ACCEL_SLOT_READ 1u
#define ACCEL_SLOT_WRITE 2u

#define ACCEL_STREAM_WORDS_MAX (1u << 28)

/* An empty stream, without slots. */
int accel_stream_new(struct accel_device *device, struct accel_stream **stream);
/* Forgets words and slots that were not submitted. */
void accel_stream_free(struct accel_stream *stream);
/*
 * Appends a copy of @count words. The library does not check them, the board does.
 * @words may be NULL if @count is 0.
 * -E2BIG: the stream would have more than ACCEL_STREAM_WORDS_MAX words.
 */
int accel_stream_emit(struct accel_stream *stream, const uint32_t *words, size_t count);
/*
 * Puts a buffer into the job's slot table and returns the number of its slot, 0 to 15.
 * A buffer has one slot. Its rights are those that any call has asked for, by @rights of
 * ACCEL_SLOT_*. -ENOSPC: the table is full. -EINVAL: the buffer is another device's, or
 * @rights has no right or others.
 */
int accel_stream_slot(struct accel_stream *stream, struct accel_buffer *buffer,
		      unsigned int rights);
/* The words so far, *@count of them. They are valid until another function is called with
 * @stream. Without words the result may be NULL. */
const uint32_t *accel_stream_words(const struct accel_stream *stream, size_t *count);
/* Forgets words and slots. */
void accel_stream_reset(struct accel_stream *stream);
/*
 * Sends the stream as a job. The board executes a device's jobs one after the other, in
 * the order of these calls. @response, of @response_words words, receives the answers. It
 * may be NULL if that is 0. It belongs to the board until the fence has been waited for to
 * the end, or freed. On success the stream is empty, and *@fence is the caller's to wait
 * for and free. @fence may be NULL if there is no response: then nobody waits for the job,
 * and accel_device_finish tells if it failed.
 * -EINVAL: @response or @fence is NULL and must not be, or the board takes no stream or
 * response of this length. -EIO, -ENODEV.
 */
int accel_stream_submit(struct accel_stream *stream, uint32_t *response, uint32_t response_words,
			struct accel_fence **fence);
/*
 * Sends the stream as accel_stream_submit does, and waits for the job; then the stream is empty
 * whatever became of it.
 * -EINVAL: as there. -EIO, -ETIME, -ENODEV, -ENOMEM: as there, or as accel_fence_wait.
 */
int accel_stream_finish(struct accel_stream *stream, uint32_t *response, uint32_t response_words);

/* ---- fence ---- */

/* How a job ended. */
struct accel_fence_status {
	unsigned int fault;      /* enum gloss_fault; 0: none */
	uint32_t offset;         /* the fault's word of the stream; without one its length */
	uint32_t response_words; /* words of the response that are valid */
};

/*
 * Waits until a job has ended: @timeout_ns nanoseconds at most, for ever if that is
 * negative, not at all if it is 0. If the fence is of several jobs it waits for all, and
 * returns what the first that failed would. A wait after the end returns the same again.
 * @status, of which the caller has @size bytes, may be NULL; all results but -ETIMEDOUT
 * fill it.
 * 0: the job was done. -EIO: the job ended with a fault, which is in @status; if there is
 * none, the board failed and was reset. -ETIMEDOUT: the job has not ended. -ETIME: it ran
 * longer than a job may ("drm:" only) and may have done a part. -ENODEV: the board is
 * gone. -ENOMEM: there was no memory to run the whole job.
 */
int accel_fence_wait(struct accel_fence *fence, int64_t timeout_ns,
		     struct accel_fence_status *status, size_t size);
/*
 * Returns a file descriptor, 0 or more, that poll() finds readable once the fence's jobs have
 * ended: it is that of the last of them, which the board runs after the others. It is a sync file
 * of the kernel, which other drivers can wait for. It is the caller's to close, may outlive the
 * fence and its device, and is no wait: of how the jobs ended accel_fence_wait tells.
 * -ENOTSUP: the device is not a "drm:". -EMFILE: no more files can be opened. -EIO, -ENODEV.
 */
int accel_fence_fd(struct accel_fence *fence);
/* Waits for the job first; so the response buffer may be freed after it. */
void accel_fence_free(struct accel_fence *fence);

#ifdef __cplusplus
}
#endif

#include "accel_draw.h"

#endif
