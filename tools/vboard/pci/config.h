/* SPDX-License-Identifier: MIT */
/* The PCI configuration space of a board. */
#ifndef VBOARD_CONFIG_H
#define VBOARD_CONFIG_H

#include <stdbool.h>
#include <stdint.h>

#define VBOARD_CONFIG_BYTES 256

/*
 * Gloss has no PCI ids of its own. A board uses those under which FPGA boards come,
 * and drivers look at its registers too (GLOSS_REG_IDENTITY).
 */
#define VBOARD_VENDOR 0x10ee
#define VBOARD_DEVICE 0x474c
#define VBOARD_SUBSYSTEM 0x534f

enum vboard_bar {
	VBOARD_BAR_REGISTERS,
	VBOARD_BAR_FAULTS, /* a real board has none */
	VBOARD_BARS,
};

#define VBOARD_REGISTERS_BYTES 0x10000
#define VBOARD_FAULTS_BYTES 0x1000

struct vboard_config {
	uint8_t bytes[VBOARD_CONFIG_BYTES];
	uint8_t writable[VBOARD_CONFIG_BYTES];
};

/* As after power on. */
void vboard_config_reset(struct vboard_config *config);

/*
 * An access of 1, 2 or 4 bytes. One that is not, or not within the space, reads all
 * ones and writes nothing.
 */
uint32_t vboard_config_read(const struct vboard_config *config, uint32_t address, int bytes);
void vboard_config_write(struct vboard_config *config, uint32_t address, uint32_t value, int bytes);

/* The BAR that decodes @bytes bytes at bus address @address, and where in it; -1: none. */
int vboard_config_find(const struct vboard_config *config, uint64_t address, uint32_t bytes,
		       uint32_t *offset);

bool vboard_config_bus_master(const struct vboard_config *config);

/* Whether interrupts are messages. */
bool vboard_config_msi(const struct vboard_config *config);

/* The write that is the message. */
void vboard_config_message(const struct vboard_config *config, uint64_t *address, uint16_t *data);

/* Shows the level of INTx in the status register; whether the pin may follow it. */
bool vboard_config_intx(struct vboard_config *config, bool level);

#endif
