// SPDX-License-Identifier: MIT
#include <assimp/cimport.h>
#include <assimp/material.h>
#include <errno.h>
#include <math.h>
#include <string.h>

#include "scene/mesh_part.h"

/* Of 20 triangles one may have normals on the wrong side: slivers do, in good meshes. */
#define WRONG_IN 20

static const struct aiVector3D zero;

/* ---- normals that fit the triangles ---- */

static struct aiVector3D minus(struct aiVector3D a, struct aiVector3D b)
{
	return (struct aiVector3D){ a.x - b.x, a.y - b.y, a.z - b.z };
}

/* The side on which the triangle's normals are: above 0 that from which it is wound to the left. */
static double side(const struct aiMesh *mesh, const unsigned int index[3])
{
	struct aiVector3D u = minus(mesh->mVertices[index[1]], mesh->mVertices[index[0]]);
	struct aiVector3D v = minus(mesh->mVertices[index[2]], mesh->mVertices[index[0]]);
	double sum = 0;

	for (int i = 0; i < 3; i++) {
		struct aiVector3D n = mesh->mNormals[index[i]];

		sum += ((double)u.y * v.z - (double)u.z * v.y) * n.x +
		       ((double)u.z * v.x - (double)u.x * v.z) * n.y +
		       ((double)u.x * v.y - (double)u.y * v.x) * n.z;
	}
	return sum;
}

static bool is_triangle(const struct aiMesh *mesh, const struct aiFace *face)
{
	return face->mNumIndices == 3 && face->mIndices[0] < mesh->mNumVertices &&
	       face->mIndices[1] < mesh->mNumVertices && face->mIndices[2] < mesh->mNumVertices;
}

static bool normals_fit(const struct aiMesh *mesh)
{
	uint64_t right = 0, wrong = 0;

	for (unsigned int i = 0; i < mesh->mNumFaces; i++) {
		const struct aiFace *face = &mesh->mFaces[i];
		double where = is_triangle(mesh, face) ? side(mesh, face->mIndices) : 0;

		right += where > 0;
		wrong += where < 0;
	}
	return wrong * WRONG_IN <= right + wrong;
}

static bool has_normals(const struct part *part)
{
	return part->normals && part->mesh->mNormals && normals_fit(part->mesh);
}

/* ---- colours ---- */

static const struct aiColor4D white = { 1, 1, 1, 1 };

static bool is_white(const struct aiColor4D *colour)
{
	return colour->r == 1 && colour->g == 1 && colour->b == 1;
}

/* White if there is none. A texture is not drawn, its material's colour is. */
static struct aiColor4D material_colour(const struct part *part)
{
	struct aiColor4D colour;

	if (!part->material)
		return white;
	if (!aiGetMaterialColor(part->material, AI_MATKEY_BASE_COLOR, &colour) ||
	    !aiGetMaterialColor(part->material, AI_MATKEY_COLOR_DIFFUSE, &colour))
		return colour;
	return white;
}

static bool has_colours(const struct part *part)
{
	struct aiColor4D colour = material_colour(part);

	return part->mesh->mColors[0] || !is_white(&colour);
}

/* 0 to 1 as a picture has it: sRGB's curve if @value is linear. */
static float channel(const struct part *part, float value)
{
	float shown = value > 0 ? value < 1 ? value : 1 : 0; /* NaN to 0 */

	if (!part->linear)
		return shown;
	return shown < 0.0031308f ? shown * 12.92f : 1.055f * powf(shown, 1 / 2.4f) - 0.055f;
}

static void set_colour(const struct part *part, const struct aiColor4D *material,
		       unsigned int vertex, float out[4])
{
	struct aiColor4D own = part->mesh->mColors[0] ? part->mesh->mColors[0][vertex] : white;

	out[0] = channel(part, own.r * material->r);
	out[1] = channel(part, own.g * material->g);
	out[2] = channel(part, own.b * material->b);
	out[3] = 1;
}

/* ---- counting and appending ---- */

static bool all_finite(const struct aiMesh *mesh)
{
	for (unsigned int i = 0; i < mesh->mNumVertices; i++)
		if (!isfinite(mesh->mVertices[i].x) || !isfinite(mesh->mVertices[i].y) ||
		    !isfinite(mesh->mVertices[i].z))
			return false;
	return true;
}

void part_count(const struct part *part, struct part_total *total)
{
	if (total->most < part->mesh->mNumVertices)
		total->most = part->mesh->mNumVertices;
	total->vertices += part->mesh->mNumVertices;
	for (unsigned int i = 0; i < part->mesh->mNumFaces; i++)
		total->triangles += part->mesh->mFaces[i].mNumIndices == 3;
	total->normals |= has_normals(part);
	total->colours |= has_colours(part);
	total->finite &= all_finite(part->mesh);
}

/*
 * For normals: the transposed inverse of the upper 3x3, but for a positive factor. A negative
 * determinant mirrors, and then triangles are wound the other way.
 */
static double normal_matrix(const struct aiMatrix4x4 *m, double n[3][3])
{
	const double a[3][3] = {
		{ m->a1, m->a2, m->a3 },
		{ m->b1, m->b2, m->b3 },
		{ m->c1, m->c2, m->c3 },
	};
	double determinant = 0;

	for (int row = 0; row < 3; row++)
		for (int column = 0; column < 3; column++) {
			const double *p = a[(row + 1) % 3], *q = a[(row + 2) % 3];
			int j = (column + 1) % 3, k = (column + 2) % 3;

			n[row][column] = p[j] * q[k] - p[k] * q[j];
		}
	for (int i = 0; i < 3; i++)
		determinant += a[0][i] * n[0][i];
	for (int i = 0; i < 9 && determinant < 0; i++)
		n[i / 3][i % 3] *= -1;
	return determinant;
}

static void set_position(float out[3], const struct aiMatrix4x4 *m, struct aiVector3D v)
{
	out[0] = m->a1 * v.x + m->a2 * v.y + m->a3 * v.z + m->a4;
	out[1] = m->b1 * v.x + m->b2 * v.y + m->b3 * v.z + m->b4;
	out[2] = m->c1 * v.x + m->c2 * v.y + m->c3 * v.z + m->c4;
}

/* Of unit length; zero, that is to be made anew, if it has no direction. */
static void set_normal(float out[3], const double n[3][3], struct aiVector3D v)
{
	double turned[3], length = 0;

	for (int row = 0; row < 3; row++) {
		turned[row] = n[row][0] * v.x + n[row][1] * v.y + n[row][2] * v.z;
		length += turned[row] * turned[row];
	}
	length = sqrt(length);
	for (int row = 0; row < 3; row++)
		out[row] = length > 0 && isfinite(length) ? (float)(turned[row] / length) : 0;
}

/* @number is that of each of the part's vertices. */
static int append_triangles(const struct aiMesh *mesh, bool mirrored, const uint32_t *number,
			    struct mesh *raw)
{
	for (unsigned int i = 0; i < mesh->mNumFaces; i++) {
		const struct aiFace *face = &mesh->mFaces[i];
		uint32_t *out = raw->triangle[raw->triangles];

		/* Points and lines are left out. */
		if (face->mNumIndices != 3)
			continue;
		if (!is_triangle(mesh, face))
			return -EINVAL;
		for (int corner = 0; corner < 3; corner++)
			out[mirrored ? 2 - corner : corner] = number[face->mIndices[corner]];
		raw->triangles++;
	}
	return 0;
}

/* What of a vertex all of the part's have in common. */
struct common {
	const struct part *part;
	double normal[3][3];
	bool normals; /* those of the file */
	struct aiColor4D colour;
};

static void set_vertex(const struct common *common, const struct mesh *raw, unsigned int i,
		       struct weld_vertex *vertex)
{
	const struct aiMesh *mesh = common->part->mesh;

	set_position(vertex->position, &common->part->place, mesh->mVertices[i]);
	if (raw->normal)
		set_normal(vertex->normal, (const double(*)[3])common->normal,
			   common->normals ? mesh->mNormals[i] : zero);
	if (raw->colour)
		set_colour(common->part, &common->colour, i, vertex->colour);
}

static int append_vertices(const struct common *common, struct weld *weld, uint32_t *number)
{
	unsigned int vertices = common->part->mesh->mNumVertices;
	struct weld_vertex block[WELD_BLOCK];
	int ret = 0;

	for (unsigned int first = 0; first < vertices && !ret; first += WELD_BLOCK) {
		unsigned int left = vertices - first;
		unsigned int count = left < WELD_BLOCK ? left : WELD_BLOCK;

		for (unsigned int i = 0; i < count; i++)
			set_vertex(common, weld->mesh, first + i, &block[i]);
		ret = weld_add(weld, block, count, number + first);
	}
	return ret;
}

int part_append(const struct part *part, struct weld *weld, uint32_t *number)
{
	struct common common = { .part = part, .colour = material_colour(part) };
	double determinant = normal_matrix(&part->place, common.normal);
	int ret;

	common.normals = weld->mesh->normal && has_normals(part);
	ret = append_vertices(&common, weld, number);
	return ret ? ret : append_triangles(part->mesh, determinant < 0, number, weld->mesh);
}
