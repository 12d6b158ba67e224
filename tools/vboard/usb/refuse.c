// SPDX-License-Identifier: MIT
/* What usbredir's parser wants to be there for transfers that a USB board does not have. */
#include "vboard/usb/vboard.h"

static void refuse_tell_iso(struct vboard_usb *usb, uint64_t id, uint8_t endpoint)
{
	struct usb_redir_iso_stream_status_header status = {
		.status = usb_redir_inval,
		.endpoint = endpoint,
	};

	usbredirparser_send_iso_stream_status(usb->parser, id, &status);
}

static void refuse_start_iso(void *data, uint64_t id,
			     struct usb_redir_start_iso_stream_header *start)
{
	refuse_tell_iso(data, id, start->endpoint);
}

static void refuse_stop_iso(void *data, uint64_t id, struct usb_redir_stop_iso_stream_header *stop)
{
	refuse_tell_iso(data, id, stop->endpoint);
}

static void refuse_tell_streams(struct vboard_usb *usb, uint64_t id, uint32_t endpoints)
{
	struct usb_redir_bulk_streams_status_header status = {
		.endpoints = endpoints,
		.status = usb_redir_inval,
	};

	usbredirparser_send_bulk_streams_status(usb->parser, id, &status);
}

static void refuse_alloc_streams(void *data, uint64_t id,
				 struct usb_redir_alloc_bulk_streams_header *alloc)
{
	refuse_tell_streams(data, id, alloc->endpoints);
}

static void refuse_free_streams(void *data, uint64_t id,
				struct usb_redir_free_bulk_streams_header *streams)
{
	refuse_tell_streams(data, id, streams->endpoints);
}

static void refuse_iso(void *data, uint64_t id, struct usb_redir_iso_packet_header *head,
		       uint8_t *bytes, int count)
{
	struct vboard_usb *usb = data;

	(void)id, (void)head, (void)count;
	usbredirparser_free_packet_data(usb->parser, bytes);
}

static void refuse_interrupt(void *data, uint64_t id,
			     struct usb_redir_interrupt_packet_header *head, uint8_t *bytes,
			     int count)
{
	struct vboard_usb *usb = data;

	(void)count;
	usbredirparser_free_packet_data(usb->parser, bytes);
	head->status = usb_redir_inval;
	head->length = 0;
	usbredirparser_send_interrupt_packet(usb->parser, id, head, NULL, 0);
}

void vboard_usb_refuse_others(struct usbredirparser *parser)
{
	parser->iso_packet_func = refuse_iso;
	parser->interrupt_packet_func = refuse_interrupt;
	parser->start_iso_stream_func = refuse_start_iso;
	parser->stop_iso_stream_func = refuse_stop_iso;
	parser->alloc_bulk_streams_func = refuse_alloc_streams;
	parser->free_bulk_streams_func = refuse_free_streams;
}
