/* SPDX-License-Identifier: MIT */
/* A port's way to host memory, and the lists of pages there; all words are little-endian there. */
#ifndef VBOARD_PORT_DMA_H
#define VBOARD_PORT_DMA_H

#include <stdbool.h>
#include <stdint.h>

#include "vboard/board/board.h"

struct port_dma {
	const struct gloss_board_host *host;
	uint64_t refused; /* address of the last access that was */
};

enum gloss_dma port_dma_read(struct port_dma *dma, uint64_t address, uint32_t *words,
			     uint32_t count);
/* Turns @words to little-endian in place. */
enum gloss_dma port_dma_write(struct port_dma *dma, uint64_t address, uint32_t *words,
			      uint32_t count);

/* Words in pages that a list names, taken from the first to the last. */
struct port_list {
	uint64_t address; /* of the list */
	uint32_t words;   /* in its pages */
	uint32_t at;      /* the next word */
	uint64_t page;    /* that it is in, unless it is a page's first */
};

void port_list_init(struct port_list *list, uint32_t address_low, uint32_t address_high,
		    uint32_t words);
static inline uint32_t port_list_left(const struct port_list *list)
{
	return list->words - list->at;
}
/* Words left in the page of the next word. */
uint32_t port_list_in_page(const struct port_list *list);

/* The next @count words, at most port_list_left. False: an access was refused. */
bool port_list_read(struct port_list *list, struct port_dma *dma, uint32_t *words, uint32_t count);
/* Turns @words to little-endian in place. */
bool port_list_write(struct port_list *list, struct port_dma *dma, uint32_t *words, uint32_t count);

#endif
