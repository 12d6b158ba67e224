/* SPDX-License-Identifier: MIT */
/*
 * libaccel: draws on a Gloss board.
 *
 * Two levels share the nouns below. At the draw level a program hands over
 * meshes, matrices, lights and materials, and the library transforms, lights,
 * chooses the shading of each triangle, bins triangles to tiles and packs the
 * command stream. At the stream level a program packs its own (packets are in
 * gloss_packets.h, their meaning in rtl/INTERFACE.md).
 *
 * Errors. Functions return 0 or a positive count, or a negative errno value;
 * a message saying what failed goes to the device's message function if there
 * is one. The library does not print, exit or abort. Any function that takes
 * memory may return -ENOMEM, and one that talks to the board -EIO (the board
 * refused or failed) and -ENODEV (it is gone). A call that fails has no effect
 * but where it says so. A pointer is not NULL where it is not said that it may be.
 *
 * Threads. A device may be used by any number of threads at once. Every other
 * object is to be used by one thread at a time; different objects, also of one
 * device, by different threads at once. No call is a cancellation point: a thread
 * that is cancelled (deferred, as is the default) ends after the call.
 *
 * Waiting. These wait for jobs: accel_fence_wait and accel_fence_free until theirs
 * have ended, and so do all that read or write a buffer or a target, and a submit
 * that is given no fence. accel_stream_submit and accel_draw_submit wait also while
 * the board has more to do than is worth queueing. accel_device_new and
 * accel_device_list ask boards, accel_device_clocks its board, and the last free of
 * a device and all that is of it ends its use: each takes seconds at most if the
 * board does not answer. No other call waits for a board, or for a thread that does.
 *
 * Processes. After fork() a device and what is of it are the parent's alone. In the
 * child each call that needs the board answers -ENODEV, at once. A _free there gives
 * back the object itself and waits for nothing; board memory, jobs, the claim of a
 * board and its file descriptors are left as they are, and so is the child's copy of
 * what the device has in memory, until the child ends or calls exec. A child that is
 * to draw opens a device of its own; one that lives on may keep a board on USB busy
 * after its parent was killed. The library stays loaded: dlclose() does not take it
 * away from its threads.
 *
 * Environment. ACCEL_DUMP=FOLDER makes each device that is opened write the jobs of
 * accel_draw_submit and accel_stream_submit to files in that folder, for gloss-decode(1); such a
 * submit waits for the jobs before it. What fails there is a message and no error.
 * GLOSS_SIM_PATH=FOLDER is where "sim:" looks for its plugin first. A program that runs with
 * more rights than its user ignores both.
 *
 * Ownership. Every _new has its _free, which takes NULL. An object keeps what
 * it was made from, and what it refers to, alive: freeing a device with buffers
 * left frees it when the last buffer goes, and a buffer named by a stream or by
 * a job that runs goes when these have done with it.
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

#define ACCEL_LIGHTS 8
#define ACCEL_TARGET_SIZE_MAX 2048

struct accel_device;
struct accel_buffer;
struct accel_target;
struct accel_state;
struct accel_draw;
struct accel_stream;
struct accel_fence;

/* ---- device ---- */

struct accel_device_info {
	char name[64];			/* for people */
	uint32_t tile_size;		/* pixels, 32 or 64 */
	uint32_t pixels_per_clock;
	uint64_t memory_size;		/* bytes */
};

/*
 * Receives one line without a newline, which is lent for the call. Called from the
 * thread of the failing call, so perhaps from several at once; it may call the library.
 */
typedef void (*accel_message_fn)(void *data, const char *message);

/*
 * Receives one device: the name that accel_device_new takes for it, and a line for people
 * without a newline, which says what it is or why it would not open. Both are lent for the
 * call. What a board says of itself is in them as printable ASCII, the rest as "?".
 */
typedef void (*accel_device_list_fn)(void *data, const char *name, const char *line);

/*
 * Calls @found with each device there is, in the order in which "auto" tries them: boards
 * that would not open, because another program has them or this one has no permission,
 * are listed too; none is disturbed in what it does. @found is called from this thread and
 * may call the library; what it does there does not change what is listed after it.
 * 0 also when there is none; -ENOMEM after some may have been listed.
 */
int accel_device_list(accel_device_list_fn found, void *data);

/*
 * Opens the board called @name: "drm:" (a PCI board, through the kernel module gloss),
 * "usb:" (a board on USB, through libusb), "model:" (the C model, in this process),
 * "sim:" (the Verilated RTL, in this process) or "auto" (the first of these that opens;
 * also for NULL). The colon may be left out if nothing follows.
 *
 * "drm:" is the first render node of a Gloss board that opens, "drm:/dev/dri/renderD128"
 * that node.
 *
 * "usb:" is the first Gloss board on USB that opens, "usb:1209:0001/SERIAL" the one with
 * these ids and that serial number (of several with the same the first that opens); "/SERIAL"
 * may be left out, or the ids if they are these. "usb:1-2.3" is the board at bus 1, port 3 of
 * the hub at its port 2, as accel_device_list calls boards that share a serial number. One
 * program at a time has such a board. When the cable fails, jobs that were submitted and had
 * not ended fail with -EIO, the board starts again, and the next job is as ever. Buffers hold
 * what they held, but for what those jobs were to write; if words of a job were garbled, which
 * USB itself hardly ever lets happen, any buffer may be spoilt. A board that fails sixteen times
 * and does no job meanwhile counts as gone. When the kernel has no memory to send with, jobs
 * fail with -ENOMEM, and the next may be well. When the board is unplugged, or has lost its
 * power, and so what buffers held, though it is still on the bus, all jobs fail with -ENODEV,
 * for good: it is another device to be opened.
 *
 * Options of the others follow the colon, separated by commas:
 *
 *   tile=32 or 64	pixels of a tile's side; 64 if not given
 *   lanes=1, 2, 4, 8	pixels a clock, "sim:" only; 8 if not given
 *   memory=BYTES	board memory, a multiple of 4096 up to 2^32; 256 MiB if not given
 *   stalls=SEED	"sim:" only: the board's ports stall at random; 0, the default: never
 *
 * The plugin of "sim:" is looked for in the directory $GLOSS_SIM_PATH, then in
 * sim/ beside the library, then where `make install` puts it.
 * @message may be NULL; it and @data must last as long as the device.
 * -ENODEV no such board, -ENOSYS its support is not installed or does not load, -EACCES not
 * allowed, -EBUSY another program or a driver of the kernel has it, -EINVAL a name or an
 * option that is not understood, -ENOMEM also when the kernel has none for "usb:". The
 * message says what to do about it. "auto" says nothing of a board that is not there.
 */
int accel_device_new(const char *name, accel_message_fn message, void *data,
		     struct accel_device **device);
void accel_device_free(struct accel_device *device);
void accel_device_info(struct accel_device *device, struct accel_device_info *info);

/* Where the board's clocks went, summed over the jobs that have ended since it was opened. */
struct accel_device_clocks {
	uint64_t clocks;		/* with a job */
	uint64_t stall_stream;		/* command waited for stream words */
	uint64_t stall_raster;		/* a triangle waited for raster */
	uint64_t stall_tile;		/* triangles waited for a tile buffer */
	uint64_t stall_memory;		/* command or a tile waited for board memory */
	uint64_t stall_response;	/* the response waited for the host */
};

/* -ENOTSUP: this board does not count clocks, as "model:"; -EIO: it did not say; -ENODEV. */
int accel_device_clocks(struct accel_device *device, struct accel_device_clocks *clocks);

/* ---- buffer: a range of board memory ---- */

/*
 * @size in bytes, a multiple of 4 from 4 to 2^31 (else -EINVAL); its content is
 * zero. -ENOMEM: also when board memory has no such range left.
 */
int accel_buffer_new(struct accel_device *device, uint64_t size, struct accel_buffer **buffer);
void accel_buffer_free(struct accel_buffer *buffer);

/*
 * Copies @size bytes between @data and the buffer from @offset on, in both cases
 * after all jobs that were submitted before; on return the copy is complete.
 * @offset and @size are bytes and multiples of 4; a @size of 0 does nothing.
 * Words are in the host's order. An error other than -EINVAL may leave part of
 * the copy done.
 * -EINVAL misaligned or outside the buffer, -EIO, -ENODEV.
 */
int accel_buffer_write(struct accel_buffer *buffer, uint64_t offset, const void *data,
		       uint64_t size);
int accel_buffer_read(struct accel_buffer *buffer, uint64_t offset, void *data, uint64_t size);

/* ---- target: colour and depth to draw on ---- */

/*
 * @width, @height in pixels, 1 to ACCEL_TARGET_SIZE_MAX; else -EINVAL. Colour and
 * depth are zero. It takes 8 bytes a pixel of board memory, the sides rounded up
 * to 64 pixels; -ENOMEM if there are not as many.
 */
int accel_target_new(struct accel_device *device, int width, int height,
		     struct accel_target **target);
void accel_target_free(struct accel_target *target);

/*
 * Reads the whole target, after all jobs that were submitted before: row by row
 * from the top into @pixels, @pitch bytes from a row to the next (at least
 * 4*width, a multiple of 4; bytes between the rows are left alone). A colour
 * pixel is red, green, blue, alpha bytes; a depth pixel is a uint32_t, depth in
 * bits 23:0, the others zero unless a stream of your own wrote stencil there. An
 * error other than -EINVAL may leave some rows read.
 * -EINVAL (@pitch), -EIO, -ENODEV.
 */
int accel_target_read_colour(struct accel_target *target, void *pixels, size_t pitch);
int accel_target_read_depth(struct accel_target *target, void *pixels, size_t pitch);

/* ---- state: everything a draw depends on but the mesh ---- */

enum accel_shading {
	ACCEL_SHADING_GOURAUD,		/* lit at vertices, linear in space between: as OpenGL */
	ACCEL_SHADING_ADAPTIVE,		/* the default: as much as each triangle needs (SH-ADAPT) */
	ACCEL_SHADING_QUADRATIC,	/* a second-order surface on each triangle (SH-QSURF) */
	ACCEL_SHADING_FLAT		/* one colour a triangle */
};

enum accel_compare {
	ACCEL_COMPARE_NEVER, ACCEL_COMPARE_LESS, ACCEL_COMPARE_EQUAL, ACCEL_COMPARE_LEQUAL,
	ACCEL_COMPARE_GREATER, ACCEL_COMPARE_NOTEQUAL, ACCEL_COMPARE_GEQUAL, ACCEL_COMPARE_ALWAYS
};

enum accel_cull { ACCEL_CULL_NONE, ACCEL_CULL_BACK, ACCEL_CULL_FRONT };

/* Reflectances, RGBA; @shininess is the specular exponent n, 0 to 1000.
 * Alpha of a lit pixel is diffuse[3]. */
struct accel_material {
	float emission[4], ambient[4], diffuse[4], specular[4];
	float shininess;
};

/*
 * A light, in eye space. position[3] = 0: directional, position is the
 * direction towards it; else a point. A spot has spot_cutoff 0 to 90 degrees,
 * other lights 180. Attenuation 1/(c + l*d + q*d^2) for points and spots.
 */
struct accel_light {
	bool enabled;
	float position[4];
	float ambient[4], diffuse[4], specular[4];
	float attenuation[3];		/* c, l, q */
	float spot_direction[3];
	float spot_exponent;		/* 0 to 128 */
	float spot_cutoff;
};

/*
 * Everything at its default: those said below, and as OpenGL has them identity
 * matrices, material (ambient 0.2, diffuse 0.8, nothing else, for both sides),
 * ambient light 0.2, and lights that are off, white for the first and black for
 * the others, shining along -z. A state is of no device: it may be used on all.
 */
int accel_state_new(struct accel_state **state);
void accel_state_free(struct accel_state *state);

/*
 * The functions below copy what they are given, and take effect with the next
 * accel_draw_mesh. An enum's value is one of its list.
 */

/* Model to eye, eye to clip. With a number that is not finite in one of them, accel_draw_mesh
 * refuses every mesh that has a vertex. */
void accel_state_set_modelview(struct accel_state *state, const float matrix[16]);
void accel_state_set_projection(struct accel_state *state, const float matrix[16]);
/* Window rectangle in pixels (top left, size); width < 0 is the whole target, the default. It
 * may be anywhere; with a width or height of 0, or a height < 0, nothing is drawn. */
void accel_state_set_viewport(struct accel_state *state, int x, int y, int width, int height);
/* Depth of the near and the far plane, clamped to 0..1, NaN to 0; the default is 0, 1. */
void accel_state_set_depth_range(struct accel_state *state, float near, float far);
/* Rectangle in pixels from the top left; width < 0 switches it off, the default. It may be
 * anywhere; with a width or height of 0, or a height < 0, nothing is drawn. */
void accel_state_set_scissor(struct accel_state *state, int x, int y, int width, int height);
/*
 * What is drawn where its depth compares as @func with the one in the target, and
 * with @write replaces it. ALWAYS without write is no depth test, the default.
 */
void accel_state_set_depth(struct accel_state *state, enum accel_compare func, bool write);
/* Which channels are written; all by default. */
void accel_state_set_colour_mask(struct accel_state *state, bool red, bool green, bool blue,
				 bool alpha);
/* Which faces are not drawn, none by default. Front faces are counter-clockwise on screen
 * (NDC, y up). */
void accel_state_set_cull(struct accel_state *state, enum accel_cull cull);
/* Lighting off (the default): vertex colours, or white without, are drawn as they are. */
void accel_state_set_lighting(struct accel_state *state, bool enabled);
/*
 * With lighting, a mesh's colours (limited to 0..1) are the material's ambient and diffuse
 * reflectances, of both sides, and alpha (true), or nothing (false, the default). What OpenGL
 * calls COLOR_MATERIAL, as it stands there by default. A mesh without colours has the material's.
 */
void accel_state_set_colour_material(struct accel_state *state, bool enabled);
/* Back faces are lit with the normal reversed and the back material (true), or as front
 * faces (false, the default). */
void accel_state_set_two_sided(struct accel_state *state, bool enabled);
/* Highlights seen from each pixel's own direction (true, the default) or from (0,0,1) (false). */
void accel_state_set_local_viewer(struct accel_state *state, bool enabled);
/* Light that comes from everywhere. -EINVAL: a value that is not finite. */
int accel_state_set_ambient(struct accel_state *state, const float rgba[4]);
/* @back NULL: the same as @front. -EINVAL: shininess outside 0..1000 or a value that is not
 * finite. */
int accel_state_set_material(struct accel_state *state, const struct accel_material *front,
			     const struct accel_material *back);
/* -EINVAL: @index not in 0..ACCEL_LIGHTS-1, a value that is not finite, an attenuation of a
 * point light that is negative or all zero (OpenGL takes that, and divides by zero), a spot
 * exponent or cutoff out of range. */
int accel_state_set_light(struct accel_state *state, int index, const struct accel_light *light);
void accel_state_set_shading(struct accel_state *state, enum accel_shading shading);

/* ---- mesh: lent for the duration of a call ---- */

enum accel_topology { ACCEL_TRIANGLES, ACCEL_TRIANGLE_STRIP, ACCEL_TRIANGLE_FAN };

/* Arrays of @vertices elements, tightly packed; @normal and @colour may be NULL.
 * @index NULL draws the vertices in order, and @indices is ignored. */
struct accel_mesh {
	enum accel_topology topology;
	uint32_t vertices;
	const float (*position)[3];
	const float (*normal)[3];	/* need not be unit length; NULL: flat, from the triangle */
	const float (*colour)[4];
	uint32_t indices;
	const uint32_t *index;
};

/* ---- draw: a frame being collected ---- */

#define ACCEL_CLEAR_COLOUR 1u
#define ACCEL_CLEAR_DEPTH 2u

/* What became of the triangles of a frame; zero again when the next one begins. */
struct accel_draw_stats {
	uint64_t triangles_in;		/* before clipping, culling and splitting */
	uint64_t culled;		/* out of view, turned away, or between the pixels */
	uint64_t clipped;		/* cut, and what is left drawn */
	uint64_t flat, linear, second_order;	/* drawn, after splitting */
	uint64_t split;			/* triangles that were split */
	uint64_t records;		/* TRIANGLE packets: a triangle in a tile */
	uint64_t stream_words;
	uint64_t tiles;
};

int accel_draw_new(struct accel_device *device, struct accel_draw **draw);
/* Forgets a frame that was not submitted. */
void accel_draw_free(struct accel_draw *draw);

/*
 * Clears the whole target before what is drawn after; forgets what was drawn before if both
 * are cleared. @mask of ACCEL_CLEAR_*; @depth 0 to 1; @rgba may be NULL if colour is not cleared.
 * -EINVAL: none of these. The target is that of accel_draw_mesh, of a mesh without triangles too;
 * a frame that clears and has none can not be submitted. After -ENOMEM the frame is empty.
 */
int accel_draw_clear(struct accel_draw *draw, unsigned int mask, const float rgba[4],
		     float depth);

/*
 * Draws @mesh on @target. All draws between two submits go to one target
 * (-EINVAL otherwise), which may be freed before the frame is submitted.
 * -EINVAL also: an index out of range, coordinates that are not finite, or no
 * position array; nothing of the mesh is drawn then. After -ENOMEM the frame is empty.
 *
 * Pixels are covered by OpenGL's rule, vertices rounded to 1/16 pixel. Shading
 * changes neither coverage nor depth, so passes with different shading meet. A
 * pixel is where it should be if the coordinates of its triangle, in clip space,
 * are at most 2^50 times w; beyond, edges may be drawn elsewhere.
 *
 * Colours of vertices are linear in space between them, clipped or not, with
 * ACCEL_SHADING_GOURAUD and, without lighting, ADAPTIVE: within 2/255, alpha 4/255,
 * where w differs by a factor of up to 10 along each edge and the triangle is a
 * pixel or more across.
 * Where it differs by less than one in a hundred that takes one record of linear
 * colours in a tile; by more, second-order surfaces or parts of the triangle.
 */
int accel_draw_mesh(struct accel_draw *draw, struct accel_target *target,
		    const struct accel_state *state, const struct accel_mesh *mesh);

/* Counts so far; stream words, tiles and records are known after submit. */
void accel_draw_stats(const struct accel_draw *draw, struct accel_draw_stats *stats);

/*
 * Sends the frame to the board and begins the next. On success *@fence, if @fence
 * is not NULL, is the caller's to wait for and free; with NULL the call waits itself.
 * A very large frame is several jobs, of which the fence is. -EIO the board refused
 * the stream, or there was memory for a part of the jobs only; -ENODEV. -EINVAL: it clears, and no
 * mesh has said what. If nothing could be sent (-EINVAL, -ENOMEM, -ENODEV) the frame is still
 * there; after any other result it is empty.
 */
int accel_draw_submit(struct accel_draw *draw, struct accel_fence **fence);

/* ---- stream: your own packets ---- */

#define ACCEL_SLOT_READ 1u
#define ACCEL_SLOT_WRITE 2u

#define ACCEL_STREAM_WORDS_MAX (1u << 28)

int accel_stream_new(struct accel_device *device, struct accel_stream **stream);
void accel_stream_free(struct accel_stream *stream);
/*
 * Appends @count words, which are copied. They are not looked at: the board checks
 * them. @words may be NULL if @count is 0.
 * -E2BIG: the stream would have more than ACCEL_STREAM_WORDS_MAX words.
 */
int accel_stream_emit(struct accel_stream *stream, const uint32_t *words, size_t count);
/*
 * Names a buffer in the job's slot table and returns the slot number, 0 to 15. A
 * buffer has one slot, whose @rights (of ACCEL_SLOT_*) are those of all calls.
 * -ENOSPC: the table is full; -EINVAL: the buffer is another device's, or no such rights.
 */
int accel_stream_slot(struct accel_stream *stream, struct accel_buffer *buffer,
		      unsigned int rights);
/* The words so far, *@count of them; valid until the next call with @stream that is not this
 * one. May be NULL if there are none. */
const uint32_t *accel_stream_words(const struct accel_stream *stream, size_t *count);
/* Forgets words and slots. */
void accel_stream_reset(struct accel_stream *stream);
/*
 * Sends the stream as a job: the board executes a device's jobs one after the
 * other, in the order of the calls. @response of @response_words words (may be NULL
 * if 0) receives the answers; it belongs to the board until the fence was waited
 * for to the end or freed. On success *@fence, if @fence is not NULL, is the
 * caller's to wait for and free, and the stream is empty; with NULL the call waits
 * itself, and may fail as accel_fence_wait does, with the stream empty all the same.
 * -EINVAL: no @response for its words, or more words than the board takes; -EIO, -ENODEV.
 */
int accel_stream_submit(struct accel_stream *stream, uint32_t *response, uint32_t response_words,
			struct accel_fence **fence);

/* ---- fence ---- */

/* How a job ended. */
struct accel_fence_status {
	unsigned int fault;		/* enum gloss_fault, 0: none */
	uint32_t offset;		/* word of the fault; without one the stream's length */
	uint32_t response_words;	/* that are valid */
};

/*
 * Waits for a job, @timeout_ns nanoseconds, for ever if negative, not at all if 0.
 * Of several jobs it waits for all, and answers as for the first that failed.
 * @status may be NULL; it is filled but for -ETIMEDOUT. 0 done; -EIO the job ended
 * with a fault (see @status), or, with no fault there, the board failed and was
 * reset; -ETIMEDOUT it still runs; -ETIME it ran for longer than a job may ("drm:") and
 * may have done a part; -ENODEV the board is gone; -ENOMEM there was no memory to run
 * all of it. A wait after the job has ended gives the same answer again.
 */
int accel_fence_wait(struct accel_fence *fence, int64_t timeout_ns,
		     struct accel_fence_status *status);
/* Waits for the job first, so that its response buffer may go too. */
void accel_fence_free(struct accel_fence *fence);

#ifdef __cplusplus
}
#endif

#endif
