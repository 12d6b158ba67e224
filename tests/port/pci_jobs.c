// SPDX-License-Identifier: MIT
#include "pci_jobs.h"

#include <string.h>

/* Low bits that an address has no room for may be anything. */
static void dirty_list(struct pci_test *test, uint32_t *low, uint32_t high, uint32_t words)
{
	uint64_t list = (uint64_t)high << 32 | *low;

	for (uint32_t n = 0; n < words; n += PAGE_WORDS) {
		uint32_t bits = below(test, GLOSS_PAGE_BYTES);

		for (uint32_t side = 0; side < 2; side++) {
			struct port_host *host = &test->host[side];

			port_host_set(host, list + n / PAGE_WORDS * 8,
				      port_host_get(host, list + n / PAGE_WORDS * 8) | bits);
		}
	}
	*low |= below(test, 8);
}

static void make_job(struct pci_test *test, uint32_t n)
{
	struct stream_random *stream = &test->pair.stream;
	struct gloss_job_descriptor *d = &test->job[n];

	pair_make_job(&test->pair, test->ops[0]->tile_size);
	memcpy(test->slot[n], stream->job.slot, sizeof(test->slot[n]));
	for (uint32_t side = 0; side < 2; side++)
		*d = port_host_describe(&test->host[side], &stream->job, test->sequence);
	test->sequence += 1 + below(test, 0x10000000);
	if (below(test, 2)) {
		dirty_list(test, &d->stream_list_low, d->stream_list_high, d->stream_words);
		dirty_list(test, &d->response_list_low, d->response_list_high, d->response_words);
		d->slot_table_low |= below(test, 64);
	}
}

/* Words, addresses and slots out of all bounds. */
static void make_wild(struct pci_test *test, struct gloss_job_descriptor *d)
{
	uint32_t words[GLOSS_JOB_DESCRIPTOR_WORDS];

	switch (below(test, 3)) {
	case 0:
		d->stream_words = ~below(test, 1000000);
		d->response_words = ~below(test, 1000000);
		break;
	case 1:
		for (uint32_t n = 0; n < GLOSS_SLOTS * GLOSS_SLOT_ENTRY_WORDS; n++) {
			uint64_t table = (uint64_t)d->slot_table_high << 32 |
					 (d->slot_table_low & ~63u);
			uint32_t word = (uint32_t)port_host_random(&test->pair.random);

			for (uint32_t side = 0; side < 2; side++)
				port_host_set(&test->host[side], table + 4 * n, word);
		}
		break;
	default:
		gloss_job_descriptor_pack(words, d);
		for (uint32_t n = 1; n < GLOSS_JOB_DESCRIPTOR_WORDS; n++)
			if (below(test, 2))
				words[n] = (uint32_t)port_host_random(&test->pair.random);
		gloss_job_descriptor_unpack(words, d);
	}
}

static void start(struct pci_test *test)
{
	uint32_t log2 = below(test, 4) ? below(test, 4) : below(test, 16);
	uint32_t mask = below(test, 8);

	for (uint32_t side = 0; side < 2; side++)
		port_host_start(&test->host[side], log2, mask);
	test->first = 0;
	test->started = true;
}

void pci_jobs_make(struct pci_test *test, enum kind kind)
{
	uint32_t most;

	if (!test->started)
		start(test);
	most = 1u << test->host[0].log2;
	test->jobs = 1 + below(test, most < JOBS ? most : JOBS);
	for (uint32_t n = 0; n < test->jobs; n++) {
		make_job(test, n);
		test->made[n] = test->job[n];
		if (kind == WILD && n == test->jobs - 1)
			make_wild(test, &test->job[n]);
		for (uint32_t side = 0; side < 2; side++)
			port_host_push(&test->host[side], &test->job[n]);
	}
}

/* ---- what happens to them ---- */

uint64_t pci_jobs_entry(const struct pci_test *test, uint64_t array, uint32_t bytes, uint32_t n)
{
	return array + (uint64_t)bytes * ((test->first + n) & ((1u << test->host[0].log2) - 1));
}

/* An address that a job needs; 0 if it has none of that sort. */
static uint64_t pick_poison(struct pci_test *test, uint32_t n, uint32_t *bytes)
{
	const struct gloss_job_descriptor *d = &test->job[n];
	uint64_t stream = (uint64_t)d->stream_list_high << 32 | (d->stream_list_low & ~7u);
	uint64_t response = (uint64_t)d->response_list_high << 32 | (d->response_list_low & ~7u);

	*bytes = 1;
	switch (below(test, 6)) {
	case 0:
		return pci_jobs_entry(test, test->host[0].ring, 64, n);
	case 1:
		return (uint64_t)d->slot_table_high << 32 | (d->slot_table_low & ~63u);
	case 2:
		return d->stream_words ? stream + below(test, d->stream_words) / PAGE_WORDS * 8 : 0;
	case 3:
		*bytes = GLOSS_PAGE_BYTES;
		return d->stream_words ? port_host_word(&test->host[0], stream,
							below(test, d->stream_words) / PAGE_WORDS *
								PAGE_WORDS) :
					 0;
	case 4:
		*bytes = GLOSS_PAGE_BYTES;
		return d->response_words ? port_host_word(&test->host[0], response,
							  below(test, d->response_words) /
								  PAGE_WORDS * PAGE_WORDS) :
					   0;
	default:
		return pci_jobs_entry(test, test->host[0].completion, 16, n);
	}
}

void pci_jobs_arm(struct pci_test *test, enum kind kind)
{
	uint32_t bytes = 0, later = kind == LATE ? below(test, 20) : below(test, 2) * ~0u;
	uint64_t poison = kind == POISONED ? pick_poison(test, below(test, test->jobs), &bytes) : 0;

	for (uint32_t side = 0; side < 2; side++) {
		struct port_host *host = &test->host[side];

		host->later = kind == LATE || kind == RESET ? later : 0;
		host->accesses = 0;
		host->refuse = kind == REFUSED ? 1 + below(test, 200 * test->jobs) : 0;
		host->poison = poison;
		host->poison_bytes = poison ? bytes : 0;
	}
}

static void work_some(struct pci_test *test, struct port_host *host, uint32_t most)
{
	for (uint32_t n = below(test, most + 1); n; n--)
		host->ops->work(host->board);
}

/* All at once, or one after the other while the board is at work. */
static void doorbell(struct pci_test *test, struct port_host *host)
{
	uint32_t tail = host->tail - test->jobs;

	while (below(test, 2) && tail != host->tail) {
		port_host_write(host, GLOSS_REG_TAIL, ++tail);
		work_some(test, host, 2);
	}
	port_host_ring(host);
}

static int pause_board(struct pci_test *test, struct port_host *host)
{
	uint32_t head;

	work_some(test, host, 5);
	port_host_write(host, GLOSS_REG_CONTROL, 0);
	head = port_host_read(host, GLOSS_REG_HEAD);
	if (!port_host_work(host))
		return differ(test, "a board does not end its job with enable 0");
	head = (port_host_read(host, GLOSS_REG_HEAD) - head) & 0xffff;
	if (head > 1)
		return differ(test, "a board ends %u jobs with enable 0", head);
	if (port_host_read(host, GLOSS_REG_STATUS) != GLOSS_REG_STATUS_IDLE)
		return differ(test, "a board is not idle after its job with enable 0");
	port_host_write(host, GLOSS_REG_CONTROL, GLOSS_REG_CONTROL_ENABLE);
	return 0;
}

int pci_jobs_run(struct pci_test *test, enum kind kind, uint32_t side)
{
	struct port_host *host = &test->host[side];

	doorbell(test, host);
	if (kind == PAUSED && pause_board(test, host))
		return 1;
	if (kind == RESET)
		work_some(test, host, 20);
	else if (!port_host_work(host))
		return differ(test, "board %u does not end its jobs", side);
	return 0;
}
