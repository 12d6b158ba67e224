// SPDX-License-Identifier: MIT
/* Slots of board memory, and the response buffer. */
#include <string.h>

#include "model.h"

_Static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__,
	       "words lie in board memory, which is little-endian, as in the host's");

bool model_memory_allows(const struct model *model, unsigned int slot, enum gloss_rights right,
			 uint32_t offset, uint32_t bytes)
{
	const struct gloss_slot *s = &model->job->slot[slot];

	return (s->rights & right) && (uint64_t)offset + bytes <= s->size;
}

void model_memory_read(const struct model *model, unsigned int slot, uint32_t offset,
		       uint32_t *words, uint32_t count)
{
	memcpy(words, model->memory + model->job->slot[slot].base + offset,
	       sizeof(*words) * (size_t)count);
}

void model_memory_write(struct model *model, unsigned int slot, uint32_t offset,
			const uint32_t *words, uint32_t count)
{
	memcpy(model->memory + model->job->slot[slot].base + offset, words,
	       sizeof(*words) * (size_t)count);
}

uint32_t *model_memory_answer(struct model *model, uint32_t count)
{
	uint32_t *words = model->job->response + (model->response_used - model->response_from);

	model->response_used += count;
	return words;
}
