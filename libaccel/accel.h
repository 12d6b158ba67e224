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

#define ACCEL_LIGHTS 8
#define ACCEL_TARGET_SIZE_MAX 2048

struct accel_device;
struct accel_buffer;
struct accel_target;
struct accel_state;
struct accel_draw;
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

/* ---- target: colour and depth to draw on ---- */

/*
 * @width and @height are in pixels, 1 to ACCEL_TARGET_SIZE_MAX. Colour and depth are
 * zero. A target takes 8 bytes of board memory a pixel, with both sides rounded up to
 * multiples of 64. -EINVAL: another size. -ENOMEM: also when board memory has no room.
 */
int accel_target_new(struct accel_device *device, int width, int height,
		     struct accel_target **target);
/* Does not wait, as accel_buffer_free. */
void accel_target_free(struct accel_target *target);

/* What a target has for each pixel, 4 bytes of each. */
enum accel_plane {
	ACCEL_PLANE_COLOUR, /* red, green, blue, alpha: a byte each, in this order */
	ACCEL_PLANE_DEPTH   /* a uint32_t: depth in bits 23:0, 0xffffff is 1 */
};

/* Pixels from the top left corner of a target. */
struct accel_rectangle {
	int x, y, width, height;
};

/*
 * Reads the pixels of @plane that are in @part, or all if that is NULL, after all jobs that
 * were submitted before. Rows come from the top into @pixels. @pitch is the bytes from a row
 * to the next, a multiple of 4 and at least 4 for each pixel of a row; bytes between rows are
 * left alone. Only the pixels in @part are fetched from the board, and none if it has none.
 * Bits 31:24 of a depth are zero, unless a stream of your own wrote stencil there. After an
 * error other than -EINVAL some rows may have been read.
 * -EINVAL: there is no such @plane; @part is not within the target; @pitch is none. -EIO,
 * -ENODEV.
 */
int accel_target_read(struct accel_target *target, enum accel_plane plane,
		      const struct accel_rectangle *part, void *pixels, size_t pitch);

/* ---- state: everything a draw depends on but the mesh ---- */

enum accel_shading {
	ACCEL_SHADING_GOURAUD,   /* lit at vertices, linear in space between, as in OpenGL */
	ACCEL_SHADING_ADAPTIVE,  /* the default: as much as each triangle needs */
	ACCEL_SHADING_QUADRATIC, /* one second-order surface on each triangle */
	ACCEL_SHADING_FLAT       /* one colour a triangle */
};

enum accel_compare {
	ACCEL_COMPARE_NEVER,
	ACCEL_COMPARE_LESS,
	ACCEL_COMPARE_EQUAL,
	ACCEL_COMPARE_LEQUAL,
	ACCEL_COMPARE_GREATER,
	ACCEL_COMPARE_NOTEQUAL,
	ACCEL_COMPARE_GEQUAL,
	ACCEL_COMPARE_ALWAYS
};

enum accel_cull { ACCEL_CULL_NONE, ACCEL_CULL_BACK, ACCEL_CULL_FRONT };

/*
 * Reflectances, RGBA, and the specular exponent. The alpha of a lit pixel is diffuse[3]. With all
 * members zero a surface is black and its alpha 0.
 */
struct accel_material {
	size_t size; /* of this struct, bytes: set by ACCEL_MATERIAL() */
	float emission[4], ambient[4], diffuse[4], specular[4];
	float shininess;   /* the specular exponent, 0 to 1000 */
	uint32_t reserved; /* 0 */
};
#define ACCEL_MATERIAL(...) ACCEL_SIZED(accel_material, __VA_ARGS__)

/*
 * A light, in eye space. A plain light needs no more than @enabled, @position and its colours.
 * With position[3] = 0 it is directional and position is the direction towards it; else it is
 * a point, at position / position[3]. A point is as bright at any distance; if one of
 * @attenuation is not 0, then 1/(c + l*d + q*d^2) of its light arrives at the distance d.
 * A point with a spot_cutoff is a spot: it shines so many degrees around spot_direction and no
 * farther.
 */
struct accel_light {
	size_t size; /* of this struct, bytes: set by ACCEL_LIGHT() */
	bool enabled;
	float position[4];
	float ambient[4], diffuse[4], specular[4];
	float attenuation[3];    /* c, l, q, none below 0; all 0: as 1, 0, 0 */
	float spot_direction[3]; /* all 0: as 0, 0, -1 */
	float spot_exponent;     /* how fast it gets less bright, 0 to 128 */
	float spot_cutoff;       /* degrees, above 0 to 90; 0, or 180 as in OpenGL: no spot */
	uint32_t reserved;       /* 0 */
};
#define ACCEL_LIGHT(...) ACCEL_SIZED(accel_light, __VA_ARGS__)

/*
 * A new state has the defaults that the functions below name, and OpenGL's defaults for
 * the rest. Matrices are the identity. The material of both sides has ambient 0.2 and
 * diffuse 0.8 and nothing else. The ambient light is 0.2. All lights are off; the first
 * is white and the others black, and they shine along -z. A state belongs to no device
 * and may be used with any.
 */
int accel_state_new(struct accel_state **state);
void accel_state_free(struct accel_state *state);

/*
 * The functions below copy what they are given. They take effect with the next
 * accel_draw_mesh. An argument of an enum has to be one of its values.
 */

/* Model to eye space, and eye to clip space. If a number in either is not finite,
 * accel_draw_mesh refuses every mesh that has a vertex. */
void accel_state_set_modelview(struct accel_state *state, const float matrix[16]);
void accel_state_set_projection(struct accel_state *state, const float matrix[16]);
/* The window rectangle in pixels: its top left corner and size. A width < 0, the default, means
 * the whole target. It may lie anywhere. If its width is 0 or its height <= 0, nothing is drawn. */
void accel_state_set_viewport(struct accel_state *state, int x, int y, int width, int height);
/* The depth of the near and of the far plane, 0 and 1 by default. Clamped to 0..1, NaN to 0. */
void accel_state_set_depth_range(struct accel_state *state, float near, float far);
/* Nothing is drawn outside this rectangle: pixels, from the top left corner. A width < 0, the
 * default, switches it off. It may lie anywhere. If its width is 0 or its height <= 0, nothing is
 * drawn. */
void accel_state_set_scissor(struct accel_state *state, int x, int y, int width, int height);
/*
 * A pixel is drawn if its depth compares as @func with the depth in the target. With @write
 * its depth then replaces that. The default is ALWAYS without write, which is no depth test.
 */
void accel_state_set_depth(struct accel_state *state, enum accel_compare func, bool write);
/* Which channels are written; all by default. */
void accel_state_set_colour_mask(struct accel_state *state, bool red, bool green, bool blue,
				 bool alpha);
/* Which faces are not drawn, none by default. Front faces are counter-clockwise on screen
 * (NDC, y up). */
void accel_state_set_cull(struct accel_state *state, enum accel_cull cull);
/* Off by default: the colours of vertices are drawn as they are, or white without any. */
void accel_state_set_lighting(struct accel_state *state, bool enabled);
/*
 * What a mesh's colours do while lighting is on. True: limited to 0..1 they take the place of the
 * material's ambient and diffuse reflectances, on both sides, and of its alpha. This is OpenGL's
 * COLOR_MATERIAL with its default mode. False, the default: nothing. A mesh without colours has
 * those of the material.
 */
void accel_state_set_colour_material(struct accel_state *state, bool enabled);
/* How back faces are lit. True: with the normal reversed and the back material. False, the
 * default: as front faces. */
void accel_state_set_two_sided(struct accel_state *state, bool enabled);
/* From where highlights are seen. True, the default: from the eye. False: from (0,0,1), for all
 * points of the mesh. */
void accel_state_set_local_viewer(struct accel_state *state, bool enabled);
/* The light that comes from everywhere. -EINVAL: a value is not finite. */
int accel_state_set_ambient(struct accel_state *state, const float rgba[4]);
/* @back may be NULL and is then the same as @front. -EINVAL: a shininess is outside 0..1000, a
 * value is not finite, or a size is not set or @reserved is. -E2BIG: a struct has members that
 * are not known. */
int accel_state_set_material(struct accel_state *state, const struct accel_material *front,
			     const struct accel_material *back);
/* -EINVAL: @index is not in 0..ACCEL_LIGHTS-1; a value is not finite; an attenuation of a point
 * is negative; a spot's exponent or cutoff is out of range; the size is not set or @reserved is.
 * -E2BIG: @light has members that are not known. */
int accel_state_set_light(struct accel_state *state, int index, const struct accel_light *light);
/* How light and colours vary over a triangle; ACCEL_SHADING_ADAPTIVE by default. */
void accel_state_set_shading(struct accel_state *state, enum accel_shading shading);

/* ---- mesh: lent for the duration of a call ---- */

/* What vertices make, in OpenGL's order. Triangles, their strips and fans are drawn so far. */
enum accel_topology {
	ACCEL_TOPOLOGY_POINTS,
	ACCEL_TOPOLOGY_LINES,
	ACCEL_TOPOLOGY_LINE_LOOP,
	ACCEL_TOPOLOGY_LINE_STRIP,
	ACCEL_TOPOLOGY_TRIANGLES,
	ACCEL_TOPOLOGY_TRIANGLE_STRIP,
	ACCEL_TOPOLOGY_TRIANGLE_FAN,
	ACCEL_TOPOLOGY_QUADS,
	ACCEL_TOPOLOGY_QUAD_STRIP,
	ACCEL_TOPOLOGY_POLYGON
};

/* Of a number in an array. FLOAT everywhere and normalised UBYTE for colours are read so far. */
enum accel_type {
	ACCEL_TYPE_FLOAT,
	ACCEL_TYPE_DOUBLE,
	ACCEL_TYPE_FIXED, /* s15.16 */
	ACCEL_TYPE_BYTE,
	ACCEL_TYPE_UBYTE,
	ACCEL_TYPE_SHORT,
	ACCEL_TYPE_USHORT,
	ACCEL_TYPE_INT,
	ACCEL_TYPE_UINT
};

/*
 * An element for each vertex, at any address. With no more than @data it is an array of floats
 * without gaps, as many for each vertex as the attribute has:
 *
 *	struct accel_mesh mesh = ACCEL_MESH(.topology = ACCEL_TOPOLOGY_TRIANGLES, .vertices = 3,
 *					    .position = { .data = corner });
 */
struct accel_array {
	const void *data; /* NULL: there is none */
	uint32_t stride;  /* bytes from an element to the next; 0: no gaps */
	enum accel_type type;
	uint8_t components;  /* numbers of an element; 0: all of the attribute */
	bool normalised;     /* the whole range of an integer type stands for 0 to 1 */
	bool constant;       /* the first element is all vertices', @stride is ignored */
	uint8_t reserved[5]; /* 0 */
};

struct accel_mesh {
	size_t size; /* of this struct, bytes: set by ACCEL_MESH() */
	enum accel_topology topology;
	uint32_t vertices;           /* that the arrays have */
	struct accel_array position; /* x, y, z; or x and y, and z is 0 */
	struct accel_array normal;   /* x, y, z, of any length; none: flat, from the triangle */
	struct accel_array colour;   /* RGBA; or RGB, and alpha is 1 */
	const uint32_t *index;       /* of vertices; NULL: all of them in order */
	uint32_t indices;            /* ignored without @index */
	uint32_t reserved;           /* 0 */
};
#define ACCEL_MESH(...) ACCEL_SIZED(accel_mesh, __VA_ARGS__)

/* ---- draw: a frame being collected ---- */

/* Bits of accel_clear.mask. */
#define ACCEL_CLEAR_COLOUR 1u
#define ACCEL_CLEAR_DEPTH 2u

/* What a target, all of it, is cleared to. */
struct accel_clear {
	size_t size;       /* of this struct, bytes: set by ACCEL_CLEAR() */
	unsigned int mask; /* what is cleared, of ACCEL_CLEAR_* */
	float rgba[4];     /* limited to 0..1 */
	float depth;       /* 0 to 1 */
};
#define ACCEL_CLEAR(...) ACCEL_SIZED(accel_clear, __VA_ARGS__)

/* What became of the triangles of a frame. A new frame begins at zero. */
struct accel_draw_stats {
	uint64_t triangles_in;               /* before clipping, culling and splitting */
	uint64_t culled;                     /* out of view, turned away, or between the pixels */
	uint64_t clipped;                    /* cut, with a part left that is drawn */
	uint64_t flat, linear, second_order; /* drawn, after splitting */
	uint64_t split;                      /* triangles that were split */
	uint64_t records;                    /* TRIANGLE packets: a triangle in a tile */
	uint64_t stream_words;
	uint64_t tiles;
};

/* A draw collects one frame at a time, and keeps the memory that this took for the next. */
int accel_draw_new(struct accel_device *device, struct accel_draw **draw);
/* Forgets a frame that was not submitted. */
void accel_draw_free(struct accel_draw *draw);

/*
 * Begins a frame on @target, which may be freed before the frame is submitted. The target is
 * cleared as @clear says, also if nothing is drawn then; NULL: what it has is kept, and drawn on.
 * A frame that was begun before and not submitted is forgotten.
 * -EINVAL: @target is another device's; @clear has a mask without a bit, or with others, a colour
 * that is not finite, a depth outside 0..1 (of what the mask names), or no size. -E2BIG: @clear has
 * members that are not known. After -ENOMEM no frame is begun, after other errors nothing changed.
 */
int accel_draw_begin(struct accel_draw *draw, struct accel_target *target,
		     const struct accel_clear *clear);

/*
 * Clears the whole target in the middle of a frame, before what is drawn from here on. If the mask
 * has all bits, what the frame had drawn before is forgotten.
 * -EINVAL: no frame was begun; @clear as for accel_draw_begin. -E2BIG: @clear has members that are
 * not known. After -ENOMEM the frame is forgotten, and to be begun again.
 */
int accel_draw_clear(struct accel_draw *draw, const struct accel_clear *clear);

/*
 * Draws @mesh on the frame's target as @state says.
 * -EINVAL: no frame was begun; an index out of range; a coordinate that is not finite; no
 * position array; an array or a topology that is not drawn so far; a size that is not set, or
 * a @reserved that is. -E2BIG: @mesh has members that are not known. Nothing of the mesh is drawn
 * then. After -ENOMEM the frame is forgotten, and to be begun again.
 *
 * Pixels are covered by OpenGL's rule, with vertices rounded to 1/16 pixel. Shading changes
 * neither which pixels are covered nor their depth, so passes with different shading meet.
 * Edges are exact as long as the clip coordinates of a triangle are at most 2^90 times its w.
 * Light is worked out in single precision: that of a lamp near a triangle that reaches far
 * beyond what is seen is not exact.
 *
 * With ACCEL_SHADING_GOURAUD, and without lighting with ACCEL_SHADING_ADAPTIVE, the colours of
 * vertices are linear in space between them, also on clipped triangles. They are within 2/255,
 * and alpha within 4/255, if w differs along each edge by a factor of at most 10 and the triangle
 * is at least a pixel across. A triangle along whose edges w differs by less than 1 % is one
 * record in each tile; others take second-order surfaces or are split.
 */
int accel_draw_mesh(struct accel_draw *draw, const struct accel_state *state,
		    const struct accel_mesh *mesh);

/*
 * Fills @stats, of which the caller has @size bytes: sizeof(*stats). The counts so far; stream
 * words, tiles and records are known after the submit.
 */
void accel_draw_stats(const struct accel_draw *draw, struct accel_draw_stats *stats, size_t size);

/*
 * Sends the frame to the board, and does not wait until it is drawn; the next one is to be begun.
 * On success *@fence is the caller's to wait for and free. @fence may be NULL: then nobody waits
 * for the frame, and accel_device_finish tells if it failed. Of a very large frame, which is
 * several jobs, the fence is that of all.
 * -EINVAL: no frame was begun. -EIO: the board refused the stream, or there was memory for some
 * of the jobs only. -ENODEV, -ENOMEM. After an error the frame is still there, to be submitted
 * again, unless some of its jobs were sent.
 */
int accel_draw_submit(struct accel_draw *draw, struct accel_fence **fence);

/*
 * Submits the frame as accel_draw_submit does, and waits until it is drawn.
 * -EINVAL: no frame was begun. -EIO, -ETIME, -ENODEV, -ENOMEM: as accel_draw_submit, which may
 * leave the frame there, or as accel_fence_wait.
 */
int accel_draw_finish(struct accel_draw *draw);

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

#endif
