// SPDX-License-Identifier: MIT
#include "window/x11.h"

#include <errno.h>
#include <stdlib.h>
#include <sys/ipc.h>
#include <sys/shm.h>
#include <xcb/shm.h>

#include "accel.h"
#include "window/format.h"
#include "window/x11_visual.h"

struct gloss_x11 {
	xcb_connection_t *connection;
	xcb_drawable_t drawable;
	xcb_gcontext_t gc;
	uint8_t depth;
	unsigned int pad; /* bytes that rows of an image are a multiple of */
	struct gloss_format format;
	int height; /* of the window, when it was last asked for */

	/* Pixels on their way, shared with the server if it is on this machine. */
	uint8_t *image;
	size_t image_size;
	xcb_shm_seg_t segment; /* 0: not shared */
	bool busy;             /* the server may not have read it yet */
};

/* An error of the request is nobody's: without this it would be the program's. */
static void x11_ignore(struct gloss_x11 *x11, xcb_void_cookie_t cookie)
{
	xcb_discard_reply(x11->connection, cookie.sequence);
}

static xcb_get_geometry_reply_t *x11_geometry(struct gloss_x11 *x11)
{
	xcb_generic_error_t *error = NULL;
	xcb_get_geometry_reply_t *reply = xcb_get_geometry_reply(
		x11->connection, xcb_get_geometry(x11->connection, x11->drawable), &error);

	free(error);
	return reply;
}

struct gloss_x11 *gloss_x11_open(xcb_connection_t *connection, xcb_drawable_t drawable,
				 xcb_visualid_t visual)
{
	struct gloss_x11 *x11 = calloc(1, sizeof(*x11));
	xcb_get_geometry_reply_t *geometry;

	if (!x11)
		return NULL;
	x11->connection = connection;
	x11->drawable = drawable;
	geometry = x11_geometry(x11);
	if (!geometry)
		goto err_free;
	x11->depth = geometry->depth;
	x11->height = geometry->height;
	free(geometry);
	if (!gloss_x11_visual_format(connection, drawable, x11->depth, visual, &x11->format,
				     &x11->pad))
		goto err_free;
	x11->gc = xcb_generate_id(connection);
	x11_ignore(x11, xcb_create_gc_checked(connection, x11->gc, drawable, 0, NULL));
	return x11;

err_free:
	free(x11);
	return NULL;
}

static void x11_image_free(struct gloss_x11 *x11)
{
	if (x11->segment) {
		x11_ignore(x11, xcb_shm_detach_checked(x11->connection, x11->segment));
		shmdt(x11->image);
	} else {
		free(x11->image);
	}
	x11->segment = 0;
	x11->image = NULL;
	x11->image_size = 0;
}

void gloss_x11_close(struct gloss_x11 *x11)
{
	if (!x11)
		return;
	x11_image_free(x11);
	x11_ignore(x11, xcb_free_gc_checked(x11->connection, x11->gc));
	xcb_flush(x11->connection);
	free(x11);
}

int gloss_x11_size(struct gloss_x11 *x11, int *width, int *height)
{
	xcb_get_geometry_reply_t *geometry = x11_geometry(x11);

	if (!geometry)
		return -ENODEV;
	*width = geometry->width;
	*height = geometry->height;
	x11->height = geometry->height;
	x11->busy = false;
	free(geometry);
	return 0;
}

/* The segment goes when both this process and the server have left it. A server that is not on this
 * machine, or has no memory to share, refuses. */
static void x11_image_share(struct gloss_x11 *x11, size_t size)
{
	const xcb_query_extension_reply_t *extension = xcb_get_extension_data(x11->connection,
									      &xcb_shm_id);
	xcb_generic_error_t *error;
	int id;

	if (!extension || !extension->present)
		return;
	id = shmget(IPC_PRIVATE, size, IPC_CREAT | 0600);
	if (id < 0)
		return;
	x11->image = shmat(id, NULL, 0);
	if ((intptr_t)x11->image == -1) {
		x11->image = NULL;
		goto out_remove;
	}
	x11->segment = xcb_generate_id(x11->connection);
	error = xcb_request_check(x11->connection,
				  xcb_shm_attach_checked(x11->connection, x11->segment,
							 (uint32_t)id, 0));
	if (error) {
		free(error);
		shmdt(x11->image);
		x11->image = NULL;
		x11->segment = 0;
	}
out_remove:
	shmctl(id, IPC_RMID, NULL);
}

static int x11_image_reserve(struct gloss_x11 *x11, size_t size)
{
	if (size == x11->image_size)
		return 0;
	x11_image_free(x11);
	x11_image_share(x11, size);
	if (!x11->image)
		x11->image = malloc(size);
	if (!x11->image)
		return -ENOMEM;
	x11->image_size = size;
	return 0;
}

/* As many rows at once as a request may have. */
static void x11_put_rows(struct gloss_x11 *x11, size_t pitch, int width, int height, int top)
{
	size_t most = (size_t)xcb_get_maximum_request_length(x11->connection) * 4 -
		      sizeof(xcb_put_image_request_t) - 4;
	int rows = most / pitch < (size_t)height ? (int)(most / pitch) : height;

	for (int y = 0; rows && y < height; y += rows) {
		int count = height - y < rows ? height - y : rows;

		x11_ignore(x11, xcb_put_image_checked(x11->connection, XCB_IMAGE_FORMAT_Z_PIXMAP,
						      x11->drawable, x11->gc, (uint16_t)width,
						      (uint16_t)count, 0, (int16_t)(top + y), 0,
						      x11->depth, (uint32_t)(pitch * (size_t)count),
						      x11->image + (size_t)y * pitch));
	}
}

static void x11_put_shared(struct gloss_x11 *x11, size_t pitch, int width, int height, int top)
{
	uint16_t total = (uint16_t)(pitch / x11->format.bytes);

	x11_ignore(x11, xcb_shm_put_image_checked(x11->connection, x11->drawable, x11->gc, total,
						  (uint16_t)height, 0, 0, (uint16_t)width,
						  (uint16_t)height, 0, (int16_t)top, x11->depth,
						  XCB_IMAGE_FORMAT_Z_PIXMAP, 0, x11->segment, 0));
	x11->busy = true;
}

int gloss_x11_put(struct gloss_x11 *x11, struct accel_target *target, int width, int height)
{
	size_t row = (size_t)width * 4;
	size_t pitch = ((size_t)width * x11->format.bytes + x11->pad - 1) / x11->pad * x11->pad;
	int err, now[2];

	if (x11->busy)
		gloss_x11_size(x11, &now[0], &now[1]);
	err = x11_image_reserve(x11, row * (size_t)height);
	if (!err)
		err = accel_target_read(target, ACCEL_PLANE_COLOUR, NULL, x11->image, row);
	if (err)
		return err;
	for (int y = 0; y < height; y++)
		gloss_format_row(&x11->format, x11->image + (size_t)y * row,
				 x11->image + (size_t)y * pitch, (size_t)width);
	if (x11->segment)
		x11_put_shared(x11, pitch, width, height, x11->height - height);
	else
		x11_put_rows(x11, pitch, width, height, x11->height - height);
	return xcb_flush(x11->connection) > 0 ? 0 : -ENODEV;
}
