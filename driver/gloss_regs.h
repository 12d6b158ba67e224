/* SPDX-License-Identifier: MIT */
/* Generated from rtl/gloss.xml by tools/hwgen; do not edit. */
#ifndef GLOSS_REGS_H
#define GLOSS_REGS_H

/* Version of this interface; a board reports it. */
#define GLOSS_VERSION 1u
/* "GLOS" in memory; what IDENTITY reads. */
#define GLOSS_IDENTITY 0x534f4c47u
/* Entries of the slot table. */
#define GLOSS_SLOTS 16u
/* Pages of board memory, and of host memory that lists name. */
#define GLOSS_PAGE_BYTES 4096u

/* Registers: byte offsets, masks of fields. */

/* The constant identity. */
#define GLOSS_REG_IDENTITY 0x000
/* The constant version. */
#define GLOSS_REG_VERSION 0x004
/* What the board was built with. */
#define GLOSS_REG_CAPABILITIES 0x008
#define GLOSS_REG_CAPABILITIES_TILE_SIZE 0x000000ffu
#define GLOSS_REG_CAPABILITIES_PIXELS_PER_CLOCK 0x0000ff00u
#define GLOSS_REG_CAPABILITIES_RING_MAX_LOG2 0x00ff0000u
/* Board memory, in pages of page_bytes bytes. */
#define GLOSS_REG_MEMORY_PAGES 0x00c
/* Starts and resets the board. */
#define GLOSS_REG_CONTROL 0x010
#define GLOSS_REG_CONTROL_ENABLE 0x00000001u
#define GLOSS_REG_CONTROL_RESET 0x00000002u
/* What the board is doing. */
#define GLOSS_REG_STATUS 0x014
#define GLOSS_REG_STATUS_RUNNING 0x00000001u
#define GLOSS_REG_STATUS_IDLE 0x00000002u
#define GLOSS_REG_STATUS_DMA_ERROR 0x00000004u
#define GLOSS_REG_STATUS_LOST 0x00000008u
/* The last fault of a job, or on PCI the DMA error, since the reset. */
#define GLOSS_REG_FAULT_CAUSE 0x040
#define GLOSS_REG_FAULT_CAUSE_CAUSE 0x0000000fu
/* Word offset of that fault in its stream. */
#define GLOSS_REG_FAULT_OFFSET 0x044
/* Sequence of the job that had it. */
#define GLOSS_REG_FAULT_SEQUENCE 0x048
/*
 * Stream words the core has taken and response words it has given, of all jobs since the reset,
 * modulo 2^32. A job is at work as long as this moves.
 */
#define GLOSS_REG_PROGRESS 0x054
/* Jobs that have ended since the reset, modulo 2^32. */
#define GLOSS_REG_JOBS 0x060
/*
 * Clocks in which the core had a job, of the jobs that have ended since the reset: lower half. A
 * board without a clock, or built without these counters, has 0 here and in the six registers after
 * it; so a number other than 0, once a job has ended, says that a board counts.
 */
#define GLOSS_REG_CLOCKS_LOW 0x064
/* Upper half of these clocks; it moves only when a job ends. */
#define GLOSS_REG_CLOCKS_HIGH 0x068
/* Of these clocks, modulo 2^32, those in which the core waited for stream words. */
#define GLOSS_REG_STALL_STREAM 0x06c
/* Of these clocks those in which a complete triangle waited for raster. */
#define GLOSS_REG_STALL_RASTER 0x070
/* Of these clocks those in which triangles waited for a tile buffer. */
#define GLOSS_REG_STALL_TILE 0x074
/* Of these clocks those in which the core waited for board memory. */
#define GLOSS_REG_STALL_MEMORY 0x078
/* Of these clocks those in which response words waited to be taken. */
#define GLOSS_REG_STALL_RESPONSE 0x07c

/* Structs: indices of words, masks of narrow fields. */

/*
 * A range of board memory that the job's stream may name by its number. A slot that leaves board
 * memory is the driver's mistake. A job with one harms no other job; it ends with MEMORY, or as it
 * would without that.
 */
#define GLOSS_SLOT_ENTRY_WORDS 4
/* Byte address in board memory, a multiple of 4096. */
#define GLOSS_SLOT_ENTRY_BASE_WORD 0
/* Bytes; base + size is at most 2^32. An empty slot has 0. */
#define GLOSS_SLOT_ENTRY_SIZE_WORD 1
#define GLOSS_SLOT_ENTRY_RIGHTS_WORD 2
#define GLOSS_SLOT_ENTRY_RIGHTS 0x00000003u

/* ---- bus pci ---- */

/* Logarithm to base 2 of the most entries of a job ring. */
#define GLOSS_RING_MAX_LOG2 8u

/* Registers: byte offsets, masks of fields. */

/* Events that have happened. */
#define GLOSS_REG_INTERRUPT_STATUS 0x018
#define GLOSS_REG_INTERRUPT_STATUS_DONE 0x00000001u
#define GLOSS_REG_INTERRUPT_STATUS_FAULT 0x00000002u
#define GLOSS_REG_INTERRUPT_STATUS_DMA 0x00000004u
/* Events that interrupt. */
#define GLOSS_REG_INTERRUPT_MASK 0x01c
#define GLOSS_REG_INTERRUPT_MASK_DONE 0x00000001u
#define GLOSS_REG_INTERRUPT_MASK_FAULT 0x00000002u
#define GLOSS_REG_INTERRUPT_MASK_DMA 0x00000004u
/* Address of the job ring, a multiple of 64: its lower half. */
#define GLOSS_REG_RING_LOW 0x020
/* Address of the job ring: its upper half. */
#define GLOSS_REG_RING_HIGH 0x024
/* Size of the ring and of the array of completions. */
#define GLOSS_REG_RING_LOG2 0x028
#define GLOSS_REG_RING_LOG2_LOG2 0x0000000fu
/* Where the board is in the ring. */
#define GLOSS_REG_HEAD 0x02c
#define GLOSS_REG_HEAD_JOBS 0x0000ffffu
/* Where the driver is in the ring; writing it starts the board. */
#define GLOSS_REG_TAIL 0x030
#define GLOSS_REG_TAIL_JOBS 0x0000ffffu
/* Address of the array of completions, a multiple of 16: its lower half. */
#define GLOSS_REG_COMPLETION_LOW 0x034
/* Address of the array of completions: its upper half. */
#define GLOSS_REG_COMPLETION_HIGH 0x038
/* Address of the access the host refused: its lower half. */
#define GLOSS_REG_DMA_ERROR_LOW 0x04c
/* Address of the access the host refused: its upper half. */
#define GLOSS_REG_DMA_ERROR_HIGH 0x050

/* Structs: indices of words, masks of narrow fields. */

/* An entry of the ring. Words without a field are zero, but not looked at. */
#define GLOSS_JOB_DESCRIPTOR_WORDS 16
/* The driver's number of the job; comes back in its completion. */
#define GLOSS_JOB_DESCRIPTOR_SEQUENCE_WORD 0
/* Length of the stream. */
#define GLOSS_JOB_DESCRIPTOR_STREAM_WORDS_WORD 1
/* Address of the list of the stream's pages, a multiple of 8; not looked at without words. */
#define GLOSS_JOB_DESCRIPTOR_STREAM_LIST_LOW_WORD 2
#define GLOSS_JOB_DESCRIPTOR_STREAM_LIST_HIGH_WORD 3
/* Room for the response. */
#define GLOSS_JOB_DESCRIPTOR_RESPONSE_WORDS_WORD 4
/* Address of the list of the response's pages, a multiple of 8; not looked at without words. */
#define GLOSS_JOB_DESCRIPTOR_RESPONSE_LIST_LOW_WORD 6
#define GLOSS_JOB_DESCRIPTOR_RESPONSE_LIST_HIGH_WORD 7
/* Address of the slot table, a multiple of 64: slots times a slot_entry. */
#define GLOSS_JOB_DESCRIPTOR_SLOT_TABLE_LOW_WORD 8
#define GLOSS_JOB_DESCRIPTOR_SLOT_TABLE_HIGH_WORD 9

/* How a job ended; the words of struct status behind its sequence. */
#define GLOSS_COMPLETION_WORDS 4
/* That of its descriptor. */
#define GLOSS_COMPLETION_SEQUENCE_WORD 0
#define GLOSS_COMPLETION_CAUSE_WORD 1
#define GLOSS_COMPLETION_CAUSE 0x0000000fu
/* Word offset of the fault; the stream's length without one. */
#define GLOSS_COMPLETION_OFFSET_WORD 2
/* Words of the response that were answered. */
#define GLOSS_COMPLETION_RESPONSE_WORDS_WORD 3

/* ---- bus usb ---- */

#define GLOSS_USB_VENDOR 0x1209u
#define GLOSS_USB_PRODUCT 0x1u
/* Of interface 0, whose class is ff. */
#define GLOSS_USB_SUBCLASS 0x47u
#define GLOSS_USB_PROTOCOL 1u
/* Bulk: the OUT channel. */
#define GLOSS_USB_ENDPOINT_OUT 0x1u
/* Bulk: the IN channel. */
#define GLOSS_USB_ENDPOINT_IN 0x81u
/* Interrupt: a usb_event in 8 bytes. */
#define GLOSS_USB_ENDPOINT_EVENT 0x82u
/* Request: wValue is the offset, 4 bytes in. */
#define GLOSS_USB_READ_REGISTER 1u
/* Request: wValue is the offset, 4 bytes out. */
#define GLOSS_USB_WRITE_REGISTER 2u
/* Words of a response chunk, the last of a job apart. */
#define GLOSS_USB_CHUNK_WORDS 256u
/* "SYNC" in memory. */
#define GLOSS_USB_SYNC_MAGIC 0x434e5953u
/* "JOB" in memory. */
#define GLOSS_USB_JOB_MAGIC 0x424f4au
/* "RS" in memory. */
#define GLOSS_USB_RESPONSE_MAGIC 0x5352u
/* "CD" in memory. */
#define GLOSS_USB_COMPLETION_MAGIC 0x4443u
/* "EV" in memory. */
#define GLOSS_USB_EVENT_MAGIC 0x5645u

/* Registers: byte offsets, masks of fields. */

/* What a usb_sync has to have; 0 matches none. */
#define GLOSS_REG_NONCE 0x080
/* The driver's number for this start of the board: 0 after power on, and kept by a reset. */
#define GLOSS_REG_BOOT 0x084

/* Structs: indices of words, masks of narrow fields. */

/* Makes OUT a sequence of jobs; comes back on IN. */
#define GLOSS_USB_SYNC_WORDS 4
/* The constant usb_sync_magic. */
#define GLOSS_USB_SYNC_MARK_WORD 0
/* What is in NONCE. */
#define GLOSS_USB_SYNC_NONCE_WORD 1
/* All bits of nonce inverted. */
#define GLOSS_USB_SYNC_NONCE_COMPLEMENT_WORD 2
/* All bits of mark inverted. */
#define GLOSS_USB_SYNC_MARK_COMPLEMENT_WORD 3

/* A job on OUT; its slots, its stream and a usb_job_end follow. */
#define GLOSS_USB_JOB_WORDS 4
/* How many slot_entry follow, at most the constant slots. */
#define GLOSS_USB_JOB_SLOTS_WORD 0
#define GLOSS_USB_JOB_SLOTS 0x0000001fu
/* The constant usb_job_magic. */
#define GLOSS_USB_JOB_MARK_WORD 0
#define GLOSS_USB_JOB_MARK 0xffffff00u
/* The driver's number of the job; comes back in its usb_completion. */
#define GLOSS_USB_JOB_SEQUENCE_WORD 1
/* Length of the stream. */
#define GLOSS_USB_JOB_STREAM_WORDS_WORD 2
/* Room for the response. */
#define GLOSS_USB_JOB_RESPONSE_WORDS_WORD 3

/* A job's last word on OUT. */
#define GLOSS_USB_JOB_END_WORDS 1
#define GLOSS_USB_JOB_END_CHECKSUM_WORD 0

/* A chunk of a job's response on IN; its words follow. */
#define GLOSS_USB_RESPONSE_WORDS 1
/* Words, 1 to usb_chunk_words. */
#define GLOSS_USB_RESPONSE_COUNT_WORD 0
#define GLOSS_USB_RESPONSE_COUNT 0x0000ffffu
/* The constant usb_response_magic. */
#define GLOSS_USB_RESPONSE_MARK_WORD 0
#define GLOSS_USB_RESPONSE_MARK 0xffff0000u

/* How a job ended, on IN. */
#define GLOSS_USB_COMPLETION_WORDS 5
#define GLOSS_USB_COMPLETION_CAUSE_WORD 0
#define GLOSS_USB_COMPLETION_CAUSE 0x0000000fu
/* The constant usb_completion_magic. */
#define GLOSS_USB_COMPLETION_MARK_WORD 0
#define GLOSS_USB_COMPLETION_MARK 0xffff0000u
/* That of its usb_job. */
#define GLOSS_USB_COMPLETION_SEQUENCE_WORD 1
/* Word offset of the fault; the stream's length without one. */
#define GLOSS_USB_COMPLETION_OFFSET_WORD 2
/* Words of the response that were answered. */
#define GLOSS_USB_COMPLETION_RESPONSE_WORDS_WORD 3
#define GLOSS_USB_COMPLETION_CHECKSUM_WORD 4

/* What a driver may want to know before it comes to it on IN. */
#define GLOSS_USB_EVENT_WORDS 2
/* Of the job that has ended with a fault. */
#define GLOSS_USB_EVENT_CAUSE_WORD 0
#define GLOSS_USB_EVENT_CAUSE 0x0000000fu
/* The channel is lost; cause and sequence are 0. */
#define GLOSS_USB_EVENT_LOST_WORD 0
#define GLOSS_USB_EVENT_LOST 0x00000010u
/* The constant usb_event_magic. */
#define GLOSS_USB_EVENT_MARK_WORD 0
#define GLOSS_USB_EVENT_MARK 0xffff0000u
/* That of the job. */
#define GLOSS_USB_EVENT_SEQUENCE_WORD 1

static inline const char *gloss_fault_name(unsigned int fault)
{
	switch (fault) {
	case 0:
		return "none";
	case 1:
		return "opcode";
	case 2:
		return "length";
	case 3:
		return "value";
	case 4:
		return "order";
	case 5:
		return "slot";
	case 6:
		return "response";
	case 7:
		return "memory";
	case 8:
		return "dma";
	default:
		return "unknown";
	}
}

#endif
