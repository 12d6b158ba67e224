/* SPDX-License-Identifier: MIT */
/* Batches of jobs for two boards on PCI, on two hosts that are the same, and what happens to them. */
#ifndef TESTS_PCI_JOBS_H
#define TESTS_PCI_JOBS_H

#include "pair.h"
#include "port_host.h"

#define JOBS 4
#define PAGE_WORDS (GLOSS_PAGE_BYTES / 4)

/* What happens to a batch of jobs. */
enum kind {
	PLAIN,
	LATE,     /* completions are asked for again */
	PAUSED,   /* enable is taken away and given back */
	POISONED, /* an address of a job is refused */
	REFUSED,  /* some access, another one on each board */
	RESET,    /* at some time, another one on each board */
	WILD,     /* the last job is one that no driver submits */
	KINDS
};

struct pci_test {
	struct pair pair;                     /* first: a pair is the test */
	const struct gloss_board_ops *ops[2]; /* the model's, the plugin's */
	struct port_host host[2];
	bool started;

	struct gloss_job_descriptor job[JOBS];  /* of the batch */
	struct gloss_job_descriptor made[JOBS]; /* before they were made wild */
	struct gloss_slot slot[JOBS][GLOSS_SLOTS];
	uint32_t jobs, first; /* first: its number in HEAD's count */
	uint32_t sequence;

	uint64_t batches[KINDS], ended, errors;
};

static inline uint32_t below(struct pci_test *test, uint32_t n)
{
	return pair_below(&test->pair, n);
}

#define differ(test, ...) pair_differ(&(test)->pair, __VA_ARGS__)

/* The jobs of the next batch, pushed on both hosts, which are started if they are not. */
void pci_jobs_make(struct pci_test *test, enum kind kind);
/* Readies both hosts for what happens to the batch. */
void pci_jobs_arm(struct pci_test *test, enum kind kind);
/* Lets one board do its jobs, or a part of them. 1: it can not. */
int pci_jobs_run(struct pci_test *test, enum kind kind, uint32_t side);
/* Where job @n of the batch has its entry in @array, of entries of @bytes. */
uint64_t pci_jobs_entry(const struct pci_test *test, uint64_t array, uint32_t bytes, uint32_t n);

#endif
