// SPDX-License-Identifier: MIT
#include <stdint.h>

#include "gloss_regs.h"
#include "transport/usb/checksum.h"
#include "transport/usb/job_message.h"

struct accel_usb_job *accel_usb_job_message_begin(struct accel_usb_link *link,
						  const struct accel_transport_job *from,
						  uint32_t **rest)
{
	const struct gloss_usb_job head = {
		.slots = from->slots,
		.mark = GLOSS_USB_JOB_MAGIC,
		.stream_words = from->stream_words,
		.response_words = from->response_words,
	};
	size_t words = GLOSS_USB_JOB_WORDS + GLOSS_USB_JOB_END_WORDS;
	struct accel_usb_job *job;

	words += (size_t)from->slots * GLOSS_SLOT_ENTRY_WORDS;
	if (from->stream_words > SIZE_MAX / sizeof(uint32_t) - words)
		return NULL;
	words += from->stream_words;
	job = accel_usb_job_new(link, words);
	if (!job)
		return NULL;
	gloss_usb_job_pack(job->message->word, &head);
	job->answer = (struct accel_usb_answer){
		.stream_words = from->stream_words,
		.response = from->response,
		.response_words = from->response_words,
	};
	*rest = job->message->word + GLOSS_USB_JOB_WORDS;
	return job;
}

void accel_usb_job_message_finish(struct accel_usb_job *job)
{
	const size_t end = job->bytes / sizeof(uint32_t) - GLOSS_USB_JOB_END_WORDS;
	uint32_t *words = job->message->word;
	const struct gloss_usb_job_end checked = {
		.checksum = accel_usb_checksum(0, words + GLOSS_USB_JOB_STREAM_WORDS_WORD,
					       end - GLOSS_USB_JOB_STREAM_WORDS_WORD),
	};

	gloss_usb_job_end_pack(words + end, &checked);
}
