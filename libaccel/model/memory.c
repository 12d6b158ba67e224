// SPDX-License-Identifier: MIT
/* Slots of board memory, and the response buffer. */
#include <endian.h>
#include <string.h>

#include "model.h"

bool model_memory_allows(const struct model *model, unsigned int slot, enum gloss_rights right,
			 uint32_t offset, uint32_t bytes)
{
	const struct gloss_slot *s = &model->job->slot[slot];

	return (s->rights & right) && (uint64_t)offset + bytes <= s->size;
}

/* Board memory is little-endian, words are the host's. */
void model_memory_read(const struct model *model, unsigned int slot, uint32_t offset,
		       uint32_t *words, uint32_t count)
{
	const uint8_t *from = model->memory + model->job->slot[slot].base + offset;
	uint32_t word;

	for (uint32_t n = 0; n < count; n++) {
		memcpy(&word, from + 4 * (size_t)n, sizeof(word));
		words[n] = le32toh(word);
	}
}

void model_memory_write(struct model *model, unsigned int slot, uint32_t offset,
			const uint32_t *words, uint32_t count)
{
	uint8_t *to = model->memory + model->job->slot[slot].base + offset;
	uint32_t word;

	for (uint32_t n = 0; n < count; n++) {
		word = htole32(words[n]);
		memcpy(to + 4 * (size_t)n, &word, sizeof(word));
	}
}

uint32_t *model_memory_answer(struct model *model, uint32_t count)
{
	uint32_t *words = model->job->response + (model->response_used - model->response_from);

	model->response_used += count;
	return words;
}
