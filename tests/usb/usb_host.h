/* SPDX-License-Identifier: MIT */
/* A host of a board on USB that knows no more than INTERFACE.md. */
#ifndef USB_HOST_H
#define USB_HOST_H

#include "accel_test.h"
#include "fake_usb.h"
#include "transport/usb/checksum.h"

#define NONCE 0x1234567
#define TRANSFER_BYTES 4096

struct host {
	libusb_context *context;
	libusb_device_handle *handle;
	uint32_t in[65536];
	size_t in_words;
};

static inline void bus_start(void)
{
	fake_usb_start(test_seed());
}

static inline void host_open(struct host *host)
{
	libusb_device **list;

	*host = (struct host){ .in_words = 0 };
	assert_int_equal(libusb_init(&host->context), 0);
	assert_int_equal(libusb_get_device_list(host->context, &list), 1);
	assert_int_equal(libusb_open(list[0], &host->handle), 0);
	libusb_free_device_list(list, 1);
	assert_int_equal(libusb_claim_interface(host->handle, 0), 0);
}

static inline void host_close(struct host *host)
{
	libusb_close(host->handle);
	libusb_exit(host->context);
}

static inline int host_write(struct host *host, uint16_t offset, uint32_t value)
{
	unsigned char byte[4] = { (unsigned char)value, (unsigned char)(value >> 8),
				  (unsigned char)(value >> 16), (unsigned char)(value >> 24) };

	return libusb_control_transfer(host->handle, 0x41, GLOSS_USB_WRITE_REGISTER, offset, 0,
				       byte, 4, 1000);
}

static inline uint32_t host_read(struct host *host, uint16_t offset)
{
	unsigned char byte[4];

	assert_int_equal(libusb_control_transfer(host->handle, 0xc1, GLOSS_USB_READ_REGISTER,
						 offset, 0, byte, 4, 1000),
			 4);
	return byte[0] | (uint32_t)byte[1] << 8 | (uint32_t)byte[2] << 16 | (uint32_t)byte[3] << 24;
}

/* The fake's machine and these tests' are little-endian. */
static inline void host_send(struct host *host, const uint32_t *words, size_t count)
{
	int moved;

	assert_int_equal(libusb_bulk_transfer(host->handle, GLOSS_USB_ENDPOINT_OUT,
					      (unsigned char *)words, (int)(4 * count), &moved,
					      1000),
			 0);
	assert_int_equal(moved, 4 * count);
}

/* Until there are @count words. */
static inline void host_receive(struct host *host, size_t count)
{
	int moved;

	while (host->in_words < count) {
		assert_int_equal(libusb_bulk_transfer(host->handle, GLOSS_USB_ENDPOINT_IN,
						      (unsigned char *)(host->in + host->in_words),
						      TRANSFER_BYTES, &moved, 1000),
				 0);
		assert_int_equal(moved % 4, 0);
		host->in_words += (size_t)moved / 4;
	}
	assert_int_equal(host->in_words, count);
	host->in_words = 0;
}

static inline void host_synchronise(struct host *host)
{
	uint32_t words[4] = { GLOSS_USB_SYNC_MAGIC, NONCE, ~NONCE, ~GLOSS_USB_SYNC_MAGIC };

	assert_int_equal(host_write(host, GLOSS_REG_CONTROL, GLOSS_REG_CONTROL_RESET), 4);
	assert_int_equal(host_write(host, GLOSS_REG_NONCE, NONCE), 4);
	host_send(host, words, 4);
	host_receive(host, 4);
	assert_memory_equal(host->in, words, sizeof(words));
}

/* Reads @count words of the slot at 4096 back, of which the first is written. */
static inline void host_run(struct host *host, uint32_t value, uint32_t count)
{
	uint32_t chunks = (count + 255) / 256, stream[64];
	size_t words = GLOSS_USB_JOB_WORDS + GLOSS_SLOT_ENTRY_WORDS;

	words += packet_write(stream + words, 0, 0, value);
	words += packet_read(stream + words, 0, 0, count);
	gloss_usb_job_pack(stream, &(struct gloss_usb_job){ .slots = 1,
							    .mark = GLOSS_USB_JOB_MAGIC,
							    .sequence = 5,
							    .stream_words = (uint32_t)(words - 8),
							    .response_words = count });
	gloss_slot_entry_pack(stream + 4,
			      &(struct gloss_slot_entry){ .base = 4096,
							  .size = 4096,
							  .rights = GLOSS_RIGHTS_READ_WRITE });
	stream[words] = accel_usb_checksum(0, stream + GLOSS_USB_JOB_STREAM_WORDS_WORD,
					   words - GLOSS_USB_JOB_STREAM_WORDS_WORD);
	host_send(host, stream, words + GLOSS_USB_JOB_END_WORDS);
	host_receive(host, count + chunks + GLOSS_USB_COMPLETION_WORDS);
	assert_int_equal(host->in[1], value);
	assert_int_equal(host->in[count + chunks + 1], 5);
}

#endif
