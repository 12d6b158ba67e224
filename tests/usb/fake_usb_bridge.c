/* SPDX-License-Identifier: MIT */
/*
 * The cable and the bridge behind it: transfers to packets, packets to the words of the port,
 * requests to its registers. A round moves some of what could move, as chance has it.
 */
#include <string.h>

#include "fake_usb_priv.h"

static unsigned int number(const struct fake_bridge *bridge)
{
	return (unsigned int)(bridge - fake.bridge);
}

static void bridge_empty(struct fake_bridge *bridge)
{
	bridge->out_count = bridge->packet_count = 0;
	bridge->empty_follows = false;
}

/* ---- faults ---- */

bool fake_bridge_fault(struct fake_bridge *bridge, enum fake_usb_fault fault)
{
	if (!bridge->at[fault] || --bridge->at[fault])
		return false;
	fake_usb.fired++;
	return true;
}

/* A packet of any kind is about to move; false: not any more. */
bool fake_bridge_packet(struct fake_bridge *bridge)
{
	if (fake_bridge_fault(bridge, FAKE_USB_GLITCH)) {
		bridge->ops->reset(bridge->board);
		memset(fake_usb_memory(number(bridge)), (int)fake_below(256), FAKE_USB_BOARD_BYTES);
		if (fake_below(2))
			bridge_empty(bridge);
	}
	if (fake_bridge_fault(bridge, FAKE_USB_BUS_RESET)) {
		fake_handle_lose_claims(number(bridge));
		fake_transfer_end_all(bridge, NULL,
				      fake_below(2) ? LIBUSB_TRANSFER_CANCELLED :
						      LIBUSB_TRANSFER_ERROR);
		return false;
	}
	if (fake_bridge_fault(bridge, FAKE_USB_KILL)) {
		fake_device_kill();
		return false;
	}
	if (fake_bridge_fault(bridge, FAKE_USB_UNPLUG)) {
		fake_bridge_unplug(bridge);
		if (bridge->value[FAKE_USB_UNPLUG])
			fake_bridge_plug(bridge, bridge->value[FAKE_USB_UNPLUG] > 1);
		return false;
	}
	return true;
}

/* ---- plugging ---- */

static void bridge_make_board(struct fake_bridge *bridge)
{
	const struct gloss_usb_board_ops *ops = fake_usb.board[number(bridge)].ops;

	if (bridge->ops == ops)
		return;
	fake_bridge_stop(bridge);
	bridge->ops = ops;
	bridge->board = ops->create(fake_usb_memory(number(bridge)), FAKE_USB_BOARD_BYTES);
	if (!bridge->board)
		fake_violation("no memory for a board");
	bridge_empty(bridge);
}

void fake_bridge_start(struct fake_bridge *bridge, unsigned int n)
{
	memset(bridge, 0, sizeof(*bridge));
	bridge->plug = n;
	for (int queue = 0; queue < FAKE_QUEUES; queue++)
		fake_list_init(&bridge->queue[queue]);
}

void fake_bridge_stop(struct fake_bridge *bridge)
{
	if (bridge->ops)
		bridge->ops->destroy(bridge->board);
	bridge->ops = NULL;
}

void fake_bridge_unplug(struct fake_bridge *bridge)
{
	struct fake_transfer *transfer;

	fake_usb.board[number(bridge)].present = false;
	if (!bridge->present)
		return;
	/* Before the kernel knows why, a transfer may just have failed. */
	for (int queue = 0; queue < FAKE_QUEUES; queue++) {
		transfer = bridge->queue[queue].first;
		if (transfer && !fake_below(4))
			fake_transfer_end(transfer, LIBUSB_TRANSFER_ERROR);
	}
	fake_transfer_end_all(bridge, NULL, LIBUSB_TRANSFER_NO_DEVICE);
	bridge->present = false;
}

void fake_bridge_plug(struct fake_bridge *bridge, bool power)
{
	fake_usb.board[number(bridge)].present = true;
	if (bridge->present)
		return;
	bridge_make_board(bridge);
	bridge->present = true;
	bridge->plug++;
	bridge->packet_bytes = fake_usb.board[number(bridge)].speed >= LIBUSB_SPEED_SUPER ? 1024 :
											    512;
	memset(bridge->halted, 0, sizeof(bridge->halted));
	if (power) {
		bridge->ops->reset(bridge->board);
		bridge_empty(bridge);
	}
}

/* ---- endpoint 0 ---- */

uint32_t fake_get_word(const uint8_t *byte)
{
	return byte[0] | (uint32_t)byte[1] << 8 | (uint32_t)byte[2] << 16 | (uint32_t)byte[3] << 24;
}

void fake_put_word(uint8_t *byte, uint32_t word)
{
	for (int n = 0; n < 4; n++)
		byte[n] = (uint8_t)(word >> 8 * n);
}

static void register_write(struct fake_bridge *bridge, uint32_t offset, uint32_t value)
{
	if (offset == GLOSS_REG_CONTROL && value & GLOSS_REG_CONTROL_RESET) {
		bridge->hang_in = bridge->hang_out = false;
		fake_usb.resets++;
		if (fake_bridge_fault(bridge, FAKE_USB_RESET_LASTS))
			bridge->resets_last = bridge->value[FAKE_USB_RESET_LASTS];
	}
	if (!bridge->resets_last || offset == GLOSS_REG_CONTROL)
		bridge->ops->write(bridge->board, offset, value);
}

static uint32_t register_read(struct fake_bridge *bridge, uint32_t offset)
{
	uint32_t value = bridge->ops->read(bridge->board, offset);

	if (offset != GLOSS_REG_CONTROL || !bridge->resets_last)
		return value;
	/* When it ends, what was sent meanwhile is gone. */
	bridge->resets_last--;
	if (!bridge->resets_last)
		bridge->ops->write(bridge->board, GLOSS_REG_CONTROL, GLOSS_REG_CONTROL_RESET);
	return value | GLOSS_REG_CONTROL_RESET;
}

static enum libusb_transfer_status control_run(struct fake_bridge *bridge,
					       struct libusb_transfer *public)
{
	uint8_t *setup = public->buffer, *data = setup + LIBUSB_CONTROL_SETUP_SIZE;
	uint32_t offset = setup[2] | (uint32_t)setup[3] << 8;
	uint32_t interface = setup[4] | (uint32_t)setup[5] << 8;
	uint32_t length = setup[6] | (uint32_t)setup[7] << 8;

	if (interface || offset % 4 || length < 4)
		return LIBUSB_TRANSFER_STALL;
	if (setup[0] == 0xc1 && setup[1] == GLOSS_USB_READ_REGISTER)
		fake_put_word(data, register_read(bridge, offset));
	else if (setup[0] == 0x41 && setup[1] == GLOSS_USB_WRITE_REGISTER && length == 4)
		register_write(bridge, offset, fake_get_word(data));
	else
		return LIBUSB_TRANSFER_STALL;
	public->actual_length = 4;
	return LIBUSB_TRANSFER_COMPLETED;
}

/* Whether this request is one of those that are refused, or not answered. */
static bool control_fault(struct fake_bridge *bridge, enum fake_usb_fault fault, uint32_t *left)
{
	if (fake_bridge_fault(bridge, fault))
		*left = bridge->value[fault] + 1;
	if (!*left)
		return false;
	--*left;
	return true;
}

int fake_bridge_request(struct fake_bridge *bridge)
{
	if (!fake_bridge_packet(bridge))
		return LIBUSB_ERROR_NO_DEVICE;
	if (control_fault(bridge, FAKE_USB_HANG_CONTROL, &bridge->silences))
		return LIBUSB_ERROR_TIMEOUT;
	return control_fault(bridge, FAKE_USB_REFUSE_CONTROL, &bridge->refusals) ?
		       LIBUSB_ERROR_PIPE :
		       0;
}

static bool control_pump(struct fake_bridge *bridge)
{
	struct fake_transfer *transfer = bridge->queue[FAKE_CONTROL].first;

	if (!transfer || transfer->lost)
		return false;
	if (!fake_bridge_packet(bridge))
		return true;
	/* One that is not answered holds up those behind it. */
	if (control_fault(bridge, FAKE_USB_HANG_CONTROL, &bridge->silences))
		transfer->lost = true;
	else if (control_fault(bridge, FAKE_USB_REFUSE_CONTROL, &bridge->refusals))
		fake_transfer_end(transfer, LIBUSB_TRANSFER_STALL);
	else
		fake_transfer_end(transfer, control_run(bridge, &transfer->public));
	return true;
}

/* ---- everything ---- */

static bool cancel_pump(struct fake_bridge *bridge)
{
	struct fake_transfer *transfer, *next;
	bool moved = false;

	for (int queue = 0; queue < FAKE_QUEUES; queue++)
		for (transfer = bridge->queue[queue].first; transfer; transfer = next) {
			next = transfer->next;
			if (!transfer->cancelled)
				continue;
			moved = true;
			if (fake_below(2))
				fake_transfer_end(transfer, LIBUSB_TRANSFER_CANCELLED);
		}
	return moved;
}

static bool bridge_pump(struct fake_bridge *bridge)
{
	static bool (*const step[])(struct fake_bridge *) = {
		cancel_pump,  control_pump, fake_out_pump,   fake_out_offer,
		fake_in_take, fake_in_pump, fake_event_pump,
	};
	bool moved = false;

	for (size_t n = 0; n < sizeof(step) / sizeof(step[0]) && bridge->present; n++) {
		/* One that is left out might have moved something. */
		if (!fake_below(8))
			moved = true;
		else if (step[n](bridge))
			moved = true;
	}
	if (!fake.held && bridge->present && bridge->ops->work(bridge->board))
		moved = true;
	return moved;
}

bool fake_bridge_pump(void)
{
	bool moved = false;

	for (struct fake_bridge *b = fake.bridge; b < fake.bridge + FAKE_USB_BOARDS; b++)
		if (b->present && bridge_pump(b))
			moved = true;
	return moved;
}
