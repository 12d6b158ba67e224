// SPDX-License-Identifier: MIT
#include "usb_host.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "transport/usb/checksum.h"

/* Steps for what no test has work enough for. */
#define STEPS_FOR_EVER 1000000

/* Longest piece of IN. */
#define TAKE_MAX 65536u

void usb_words_add(struct usb_words *words, const uint32_t *word, uint32_t count)
{
	if (words->count + count > words->room) {
		uint32_t room = 2 * words->room + count;
		uint32_t *grown = realloc(words->word, sizeof(*grown) * room);

		if (!grown) {
			fputs("usb_host: out of memory\n", stderr);
			abort();
		}
		words->word = grown;
		words->room = room;
	}
	if (count)
		memcpy(words->word + words->count, word, 4 * (size_t)count);
	words->count += count;
}

bool usb_host_init(struct usb_host *host, const struct gloss_usb_board_ops *ops, void *memory,
		   uint64_t size)
{
	*host = (struct usb_host){ .ops = ops, .offer = ~0u, .take = TAKE_MAX };
	host->board = ops->create(memory, size);
	return host->board;
}

void usb_host_fini(struct usb_host *host)
{
	host->ops->destroy(host->board);
	free(host->out.word);
	free(host->in.word);
	free(host->burst.word);
	free(host->event.word);
	free(host->response.word);
}

/* ---- what is to be sent ---- */

static void sync_words(uint32_t *words, uint32_t nonce)
{
	gloss_usb_sync_pack(words, &(struct gloss_usb_sync){
					   .mark = GLOSS_USB_SYNC_MAGIC,
					   .nonce = nonce,
					   .nonce_complement = ~nonce,
					   .mark_complement = ~GLOSS_USB_SYNC_MAGIC,
				   });
}

void usb_host_sync(struct usb_host *host, uint32_t nonce)
{
	uint32_t words[GLOSS_USB_SYNC_WORDS];

	sync_words(words, nonce);
	usb_words_add(&host->out, words, GLOSS_USB_SYNC_WORDS);
}

void usb_host_job(struct usb_host *host, const struct accel_job *job, uint32_t slots,
		  uint32_t sequence)
{
	uint32_t words[GLOSS_USB_JOB_WORDS], from;

	gloss_usb_job_pack(words, &(struct gloss_usb_job){
					  .slots = slots,
					  .mark = GLOSS_USB_JOB_MAGIC,
					  .sequence = sequence,
					  .stream_words = job->stream_words,
					  .response_words = job->response_words,
				  });
	from = host->out.count + GLOSS_USB_JOB_STREAM_WORDS_WORD;
	usb_words_add(&host->out, words, GLOSS_USB_JOB_WORDS);
	for (uint32_t n = 0; n < slots; n++) {
		gloss_slot_entry_pack(words, &(struct gloss_slot_entry){
						     .base = job->slot[n].base,
						     .size = job->slot[n].size,
						     .rights = job->slot[n].rights,
					     });
		usb_words_add(&host->out, words, GLOSS_SLOT_ENTRY_WORDS);
	}
	usb_words_add(&host->out, job->stream, job->stream_words);
	gloss_usb_job_end_pack(words,
			       &(struct gloss_usb_job_end){
				       .checksum = accel_usb_checksum(0, host->out.word + from,
								      host->out.count - from),
			       });
	usb_words_add(&host->out, words, GLOSS_USB_JOB_END_WORDS);
}

/* ---- what happens ---- */

static bool host_take(struct usb_host *host)
{
	static uint32_t words[TAKE_MAX];
	bool flush;
	uint32_t count = host->ops->in(host->board, words, host->take, &flush);

	usb_words_add(&host->in, words, count);
	if (flush)
		usb_words_add(&host->burst, &host->in.count, 1);
	return count;
}

bool usb_host_step(struct usb_host *host)
{
	uint32_t left = host->out.count - host->sent;
	uint32_t offer = host->offer < left ? host->offer : left;
	uint32_t event[GLOSS_USB_EVENT_WORDS];
	bool moved = false;

	if (offer) {
		offer = host->ops->out(host->board, host->out.word + host->sent, offer);
		host->sent += offer;
		moved = offer;
	}
	moved |= host->ops->work(host->board);
	if (host->take)
		moved |= host_take(host);
	while (host->ops->event(host->board, event))
		usb_words_add(&host->event, event, GLOSS_USB_EVENT_WORDS);
	return moved;
}

bool usb_host_run(struct usb_host *host)
{
	for (uint32_t n = 0; n < STEPS_FOR_EVER; n++)
		if (!usb_host_step(host))
			return true;
	return false;
}

bool usb_host_reset(struct usb_host *host, uint32_t nonce)
{
	uint32_t steps = 0;

	usb_host_write(host, GLOSS_REG_CONTROL, GLOSS_REG_CONTROL_RESET);
	while (usb_host_read(host, GLOSS_REG_CONTROL) && steps++ < STEPS_FOR_EVER)
		host->ops->work(host->board);
	usb_host_write(host, GLOSS_REG_NONCE, nonce);
	host->out.count = 0;
	host->sent = 0;
	host->in.count = 0;
	host->burst.count = 0;
	host->event.count = 0;
	host->read = 0;
	host->bursts_read = 0;
	return steps < STEPS_FOR_EVER;
}

uint32_t usb_host_read(struct usb_host *host, uint32_t offset)
{
	return host->ops->read(host->board, offset);
}

void usb_host_write(struct usb_host *host, uint32_t offset, uint32_t value)
{
	host->ops->write(host->board, offset, value);
}

/* ---- what came ---- */

/* The next @count words of IN, with a burst's end behind the last and nowhere else, or with none. */
static const uint32_t *host_words(struct usb_host *host, uint32_t count, bool end)
{
	const uint32_t *words = host->in.word + host->read;
	bool more = host->bursts_read < host->burst.count;

	if (count > host->in.count - host->read)
		return NULL;
	host->read += count;
	if (end != (more && host->burst.word[host->bursts_read] <= host->read))
		return NULL;
	if (end && host->burst.word[host->bursts_read++] != host->read)
		return NULL;
	return words;
}

bool usb_host_echo(struct usb_host *host, uint32_t nonce)
{
	const uint32_t *words = host_words(host, GLOSS_USB_SYNC_WORDS, true);
	uint32_t expected[GLOSS_USB_SYNC_WORDS];

	sync_words(expected, nonce);
	return words && !memcmp(words, expected, sizeof(expected));
}

/* A chunk, or the completion; false: neither. */
static bool host_message(struct usb_host *host, bool *completion)
{
	const uint32_t *words = host->in.word + host->read;
	struct gloss_usb_response head;
	uint32_t sum;

	*completion = false;
	if (host->read == host->in.count)
		return false;
	gloss_usb_response_unpack(words, &head);
	if (head.mark == GLOSS_USB_RESPONSE_MAGIC) {
		words = host_words(host, GLOSS_USB_RESPONSE_WORDS + head.count, false);
		if (!words || !head.count || head.count > GLOSS_USB_CHUNK_WORDS ||
		    host->response.count % GLOSS_USB_CHUNK_WORDS)
			return false;
		usb_words_add(&host->response, words + GLOSS_USB_RESPONSE_WORDS, head.count);
		return true;
	}
	*completion = true;
	words = host_words(host, GLOSS_USB_COMPLETION_WORDS, true);
	if (!words)
		return false;
	gloss_usb_completion_unpack(words, &host->completion);
	sum = accel_usb_checksum(0, host->response.word, host->response.count);
	return accel_usb_checksum(sum, words, GLOSS_USB_COMPLETION_CHECKSUM_WORD) ==
		       host->completion.checksum &&
	       host->completion.mark == GLOSS_USB_COMPLETION_MAGIC && !(words[0] & 0xfff0) &&
	       host->completion.response_words == host->response.count;
}

bool usb_host_answer(struct usb_host *host)
{
	bool completion = false;

	host->response.count = 0;
	while (!completion)
		if (!host_message(host, &completion))
			return false;
	return true;
}

bool usb_host_empty(const struct usb_host *host)
{
	return host->read == host->in.count && host->bursts_read == host->burst.count;
}
