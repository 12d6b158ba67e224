// SPDX-License-Identifier: MIT
#include "state/client.h"

#include "state/command.h"
#include "state/get.h"

static void client_init_array(struct gloss_client_array *array, GLint size)
{
	*array = (struct gloss_client_array){ .size = size, .type = GL_FLOAT };
}

void gloss_client_init(struct gloss_client *client)
{
	*client = (struct gloss_client){
		.pack.alignment = 4,
		.unpack.alignment = 4,
	};
	client_init_array(&client->arrays.position, 4);
	client_init_array(&client->arrays.normal, 3);
	client_init_array(&client->arrays.colour, 4);
	client_init_array(&client->arrays.index, 1);
	client_init_array(&client->arrays.edge, 1);
	client_init_array(&client->arrays.secondary, 3);
	client_init_array(&client->arrays.fog, 1);
	for (int i = 0; i < GLOSS_UNITS; i++)
		client_init_array(&client->arrays.texcoord[i], 4);
}

static GLint *client_store(struct gloss_pixel_store *store, GLenum which)
{
	switch (which) {
	case GL_PACK_ROW_LENGTH:
		return &store->row_length;
	case GL_PACK_SKIP_ROWS:
		return &store->skip_rows;
	case GL_PACK_SKIP_PIXELS:
		return &store->skip_pixels;
	case GL_PACK_ALIGNMENT:
		return &store->alignment;
	case GL_PACK_IMAGE_HEIGHT:
		return &store->image_height;
	case GL_PACK_SKIP_IMAGES:
		return &store->skip_images;
	default:
		return NULL;
	}
}

/* The name in glPixelStore's list for packing that @pname has in that for unpacking. */
static GLenum client_pack_name(GLenum pname)
{
	if (pname == GL_UNPACK_IMAGE_HEIGHT)
		return GL_PACK_IMAGE_HEIGHT;
	if (pname == GL_UNPACK_SKIP_IMAGES)
		return GL_PACK_SKIP_IMAGES;
	return pname - GL_UNPACK_SWAP_BYTES + GL_PACK_SWAP_BYTES;
}

void gl_PixelStorei(GLenum pname, GLint param)
{
	struct gloss_context *context = gloss_outside();
	struct gloss_pixel_store *store;
	GLint *value;

	if (!context)
		return;
	store = &context->client.pack;
	if ((pname >= GL_UNPACK_SWAP_BYTES && pname <= GL_UNPACK_ALIGNMENT) ||
	    pname == GL_UNPACK_IMAGE_HEIGHT || pname == GL_UNPACK_SKIP_IMAGES) {
		store = &context->client.unpack;
		pname = client_pack_name(pname);
	}
	value = client_store(store, pname);
	if (pname == GL_PACK_SWAP_BYTES)
		store->swap_bytes = param != 0;
	else if (pname == GL_PACK_LSB_FIRST)
		store->lsb_first = param != 0;
	else if (!value)
		gloss_error(context, GL_INVALID_ENUM);
	else if (param < 0 || (pname == GL_PACK_ALIGNMENT && param != 1 && param != 2 &&
			       param != 4 && param != 8))
		gloss_error(context, GL_INVALID_VALUE);
	else
		*value = param;
}

void gl_PixelStoref(GLenum pname, GLfloat param)
{
	gl_PixelStorei(pname, gloss_get_integer(GLOSS_FLOAT, (double)param));
}
