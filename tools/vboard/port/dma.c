// SPDX-License-Identifier: MIT
/* Words to and from host memory, in one piece or in pages that a list names. */
#include "vboard/port/dma.h"

#include <endian.h>

#include "gloss_packets.h"

#define PAGE_WORDS (GLOSS_PAGE_BYTES / 4)

enum gloss_dma port_dma_read(struct port_dma *dma, uint64_t address, uint32_t *words,
			     uint32_t count)
{
	enum gloss_dma answer = dma->host->read(dma->host->data, address, words, 4 * count);

	if (answer == GLOSS_DMA_REFUSED)
		dma->refused = address;
	else
		for (uint32_t n = 0; n < count; n++)
			words[n] = le32toh(words[n]);
	return answer;
}

enum gloss_dma port_dma_write(struct port_dma *dma, uint64_t address, uint32_t *words,
			      uint32_t count)
{
	enum gloss_dma answer;

	for (uint32_t n = 0; n < count; n++)
		words[n] = htole32(words[n]);
	answer = dma->host->write(dma->host->data, address, words, 4 * count);
	if (answer == GLOSS_DMA_REFUSED)
		dma->refused = address;
	return answer;
}

void port_list_init(struct port_list *list, uint32_t address_low, uint32_t address_high,
		    uint32_t words)
{
	*list = (struct port_list){
		.address = (uint64_t)address_high << 32 | (address_low & ~7u),
		.words = words,
	};
}

uint32_t port_list_in_page(const struct port_list *list)
{
	uint32_t in_page = PAGE_WORDS - list->at % PAGE_WORDS;

	return in_page < port_list_left(list) ? in_page : port_list_left(list);
}

static bool list_entry(struct port_list *list, struct port_dma *dma)
{
	uint64_t entry = list->address + (uint64_t)8 * (list->at / PAGE_WORDS);
	uint32_t words[2];

	if (port_dma_read(dma, entry, words, 2) != GLOSS_DMA_DONE)
		return false;
	list->page = ((uint64_t)words[1] << 32 | words[0]) & ~(uint64_t)(GLOSS_PAGE_BYTES - 1);
	return true;
}

/* In pieces, each inside one page. */
static bool list_access(struct port_list *list, struct port_dma *dma,
			enum gloss_dma (*access)(struct port_dma *, uint64_t, uint32_t *, uint32_t),
			uint32_t *words, uint32_t count)
{
	while (count) {
		uint32_t in_page = port_list_in_page(list);
		uint32_t piece = count < in_page ? count : in_page;

		if (list->at % PAGE_WORDS == 0 && !list_entry(list, dma))
			return false;
		if (access(dma, list->page + 4 * (list->at % PAGE_WORDS), words, piece) !=
		    GLOSS_DMA_DONE)
			return false;
		list->at += piece;
		words += piece;
		count -= piece;
	}
	return true;
}

bool port_list_read(struct port_list *list, struct port_dma *dma, uint32_t *words, uint32_t count)
{
	return list_access(list, dma, port_dma_read, words, count);
}

bool port_list_write(struct port_list *list, struct port_dma *dma, uint32_t *words, uint32_t count)
{
	return list_access(list, dma, port_dma_write, words, count);
}
